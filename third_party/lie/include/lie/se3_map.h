// SPDX-License-Identifier: BSD-3-Clause

/// Views of 7 scalars [qx qy qz qw tx ty tz] in somebody else's memory, such as a Ceres
/// parameter block, as an SE(3) element. The memory must outlive the view.
///
///   SE3Map<T>       over T*, can be assigned
///   SE3ConstMap<T>  over const T*
///
/// For arithmetic a view turns into SE3<T> (a copy of 7 scalars). The quaternion in memory
/// is taken to be of unit length.
#pragma once

#include <type_traits>

#include "lie/se3.h"

namespace lie {

/// P is T or const T.
template <class P>
class SE3View {
 public:
  using Scalar = std::remove_const_t<P>;
  using Group = SE3<Scalar>;
  template <class X>
  using Like = std::conditional_t<std::is_const_v<P>, const X, X>;
  using QuaternionMap = Eigen::Map<Like<Eigen::Quaternion<Scalar>>>;
  using TranslationMap = Eigen::Map<Like<Eigen::Matrix<Scalar, 3, 1>>>;

  explicit SE3View(P* data) : data_(data) {}
  SE3View(const SE3View&) = default;

  /// Both assignments write through to the memory; a view never changes what it views.
  SE3View& operator=(const Group& T) {
    static_assert(!std::is_const_v<P>, "a const view cannot be assigned");
    unit_quaternion() = T.unit_quaternion();
    translation() = T.translation();
    return *this;
  }
  SE3View& operator=(const SE3View& other) { return *this = other.Get(); }

  Group Get() const {
    return Group(SO3<Scalar>::FromUnitQuaternion(unit_quaternion()), translation());
  }
  operator Group() const { return Get(); }  // NOLINT(google-explicit-constructor)

  QuaternionMap unit_quaternion() const { return QuaternionMap(data_); }
  TranslationMap translation() const { return TranslationMap(data_ + 4); }
  SO3<Scalar> so3() const { return SO3<Scalar>::FromUnitQuaternion(unit_quaternion()); }
  SO3<Scalar> rotation() const { return so3(); }
  P* data() const { return data_; }

  Group inverse() const { return Get().inverse(); }
  typename Group::Tangent Log() const { return Get().Log(); }
  typename Group::Matrix4 matrix() const { return Get().matrix(); }
  Group operator*(const Group& other) const { return Get() * other; }
  template <class Derived>
  typename Group::Vector3 operator*(const Eigen::MatrixBase<Derived>& p) const {
    return Get() * p;
  }

 private:
  P* data_;
};

template <class T>
using SE3Map = SE3View<T>;
template <class T>
using SE3ConstMap = SE3View<const T>;

}  // namespace lie
