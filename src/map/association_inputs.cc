// SPDX-License-Identifier: BSD-3-Clause
#include "map/association_inputs.h"

#include <cmath>

#include "perception/projection.h"

namespace sslcd {
namespace {

// Bearing of the camera in the object frame, which defines the visible side.
double Viewpoint(const Pose& T_cam_object) {
  const Vec3 camera_in_object = T_cam_object.inverse().translation();
  return std::atan2(camera_in_object.y(), camera_in_object.x());
}

}  // namespace

AssociationQuery QueryOf(const Detection& detection, const Pose& T_world_cam,
                         const GravityFrame& gravity, const DetectionNoise& noise,
                         const NoiseScale& scale) {
  AssociationQuery query;
  query.detection = &detection;
  const Vec3 point_cam = detection.T_cam_object.translation();
  const Vec3 point_world = T_world_cam * point_cam;
  query.place.position = Horizontal(point_world, gravity);
  query.height = point_world.dot(gravity.up);
  NoiseScale cautious = scale;
  cautious.radial = std::hypot(kNoiseCaution * cautious.radial, kLongTailScale);
  cautious.lateral = std::hypot(kNoiseCaution * cautious.lateral, kLongTailScale);
  const DetectionSigmas sigmas = SigmasAt(point_cam.norm(), noise, cautious);
  const Eigen::Matrix3d R = T_world_cam.so3().matrix();
  Eigen::Matrix<double, 2, 3> to_plane;
  to_plane << gravity.forward.transpose(), gravity.left.transpose();
  const Eigen::Matrix<double, 2, 3> J = to_plane * R;
  query.place.covariance = J * PositionCovariance(point_cam, sigmas) * J.transpose();
  query.viewpoint_rad = Viewpoint(detection.T_cam_object);
  return query;
}

AssociationCandidate CandidateOf(const MapLandmark& landmark, const FrameView& view,
                                 const GravityFrame& gravity, const MotionTestOptions& motion) {
  AssociationCandidate candidate;
  candidate.label = landmark.label;
  const auto parked = landmark.motion.PredictParked(view.stamp, motion);
  const auto driving = landmark.motion.PredictDriving(view.stamp, motion);
  const PlanarGaussian parked_prediction{Horizontal(landmark.pose.position, gravity),
                                         parked.covariance};
  const PlanarGaussian driving_prediction{driving.position, driving.covariance};
  Vec3 position = landmark.pose.position;
  if (landmark.state == LandmarkState::kDynamic) {
    candidate.predictions = {driving_prediction, parked_prediction};
    const Vec2 moved = driving.position - Horizontal(position, gravity);
    position += moved.x() * gravity.forward + moved.y() * gravity.left;
  } else {
    candidate.predictions = {parked_prediction};
    if (CanMove(landmark)) candidate.predictions.push_back(driving_prediction);
  }
  candidate.height = landmark.pose.position.dot(gravity.up);
  const Pose T_cam_object =
      view.T_world_cam.inverse() * ToPose({position, landmark.pose.yaw}, gravity);
  candidate.viewpoint_rad = Viewpoint(T_cam_object);
  if (view.camera != nullptr)
    candidate.projected_box = ProjectCuboid(T_cam_object, landmark.dims, *view.camera);
  candidate.appearance = &landmark.appearance;
  return candidate;
}

}  // namespace sslcd
