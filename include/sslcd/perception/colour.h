// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/image.h"

namespace SSLCD_EXPORT sslcd {

/// Colour of an object from the pixels of its box (paper III-A.2).
struct ColourOptions {
  enum class Method {
    kRobust,  ///< clusters in a hue-safe space, compared through a fixed palette
    kPaper,   ///< clusters in HSV, vector = their shares, largest first
  };
  Method method = Method::kRobust;
  int clusters = 6;       ///< no key: K dominant colours; set by hand
  int max_pixels = 1000;  ///< no key: size of the regular grid that samples the box; set by hand
  /// share of each side of the box that is sampled, in its centre; the rest is mostly background
  double box_share = 0.7;
  /// no key: robust: largest distance of similar colours in colour space [ConeColour]; set by hand
  double softness = 0.25;
};
void DescribeFields(FieldVisitor& visitor, ColourOptions& options);

/// A dominant colour and its share of the pixels.
struct ColourCluster {
  Vec3 centre{0, 0, 0};  ///< robust: see ConeColour; paper: HSV
  double weight = 0;     ///< share of the pixels, in [0, 1]
};
using ColourSignature = std::vector<ColourCluster>;  ///< largest share first; the shares sum to one

/// Hue-safe colour space: the HSV cone [C cos(hue), C sin(hue), L], with a compressed value axis,
/// similar to human perception, so that a change of brightness changes a colour little, except near
/// black. L = log(1 + v/e) / log(1 + 1/e) and C = saturation * v (1 + e) / (v + e), e = 0.1; both
/// in [0, 1]. Arguments in [0, 1].
Vec3 ConeColour(double red, double green, double blue);

/// HSV in OpenCV's 8-bit scale: hue [0, 180), saturation and value [0, 255]. Arguments in [0, 1].
Vec3 HsvColour(double red, double green, double blue);

/// Clusters the colours of the pixels in `box`. Empty if the box has no pixel in the image. Throws
/// Error(kBadInput) unless the image has three channels, data and a stride that holds a row.
ColourSignature ExtractColour(const ImageView& image, const Box2d& box,
                              const ColourOptions& options);

/// The vector h for Detection::colour; empty for an empty signature.
/// Robust: soft assignment to a palette common to all objects, L2-normalised with entries >= 0, so
/// that the dot product of two is their cosine in [0, 1]. Paper: the K shares (with zeros at the
/// end if there are fewer clusters), which sum to one.
std::vector<float> ColourVector(const ColourSignature& signature, const ColourOptions& options);

/// ExtractColour followed by ColourVector.
std::vector<float> ColourVector(const ImageView& image, const Box2d& box,
                                const ColourOptions& options);

}  // namespace sslcd
