// SPDX-License-Identifier: BSD-3-Clause
// All sizes [m], colours (linear red, green, blue) and frequencies [1/m] of this file were set by
// hand.
#include "render/light.h"

#include "render/noise.h"

namespace sslcd::render {
namespace {

// share of the light from above that asphalt reflects
const Vec3f kGround(0.17f, 0.165f, 0.155f);

Vec3f ClearSky(const Daylight& light, float up) {
  return Mix(light.horizon, light.zenith, std::sqrt(Clamp01(up)));
}

Vec3f GroundLight(const Daylight& light) {
  return kGround.cwiseProduct(light.sun * light.to_sun.z() + 0.8f * light.zenith);
}

}  // namespace

Daylight MakeDaylight(const Light& light, std::uint32_t seed) {
  const auto radians = [](double degrees) { return static_cast<float>(degrees * M_PI / 180); };
  const float azimuth = radians(light.sun_azimuth_deg),
              elevation = radians(light.sun_elevation_deg);
  const float warmth = static_cast<float>(light.warmth);
  Daylight result;
  result.to_sun = {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                   std::sin(elevation)};
  const Vec3f tint = Vec3f(1 + 0.22f * warmth, 1, 1 - 0.35f * warmth);
  result.sun = Vec3f(2.5f, 2.35f, 2.1f).cwiseProduct(tint) * Smooth(-0.2f, 0.7f, result.to_sun.z());
  result.zenith = Vec3f(0.24f, 0.44f, 0.92f).cwiseProduct(0.5f * (tint + Vec3f::Ones()));
  result.horizon = Vec3f(0.85f, 0.95f, 1.08f).cwiseProduct(tint);
  result.exposure = static_cast<float>(light.exposure);
  result.clouds = seed;
  return result;
}

Vec3f SkyColour(const Daylight& light, const Vec3f& direction) {
  const float up = direction.z();
  Vec3f sky = ClearSky(light, up);
  if (up > 0.01f) {
    const float scale = 1.2f / (up + 0.12f);
    const float cloud =
        Fractal(direction.x() * scale, direction.y() * scale, light.clouds, {0.9f, 5}, 0.f);
    sky = Mix(sky, Vec3f(Vec3f::Constant(0.55f) + 0.22f * light.sun),
              0.85f * Smooth(0.05f, 0.75f, cloud) * Smooth(0.01f, 0.2f, up));
  }
  const float glow = std::max(direction.dot(light.to_sun), 0.f);
  return sky + light.sun * (0.12f * std::pow(glow, 24.f) + 6 * Smooth(0.9997f, 0.9999f, glow) +
                            0.5f * std::pow(glow, 400.f));
}

Vec3f Shade(const Daylight& light, const Surface& surface, const Vec3f& normal, const Vec3f& view,
            float sunlit, float sky) {
  const float slant = std::max(normal.dot(light.to_sun), 0.f), up = 0.5f + 0.5f * normal.z();
  const Vec3f ambient =
      Mix(GroundLight(light), Vec3f(0.75f * light.zenith + 0.3f * light.horizon), up);
  Vec3f colour = surface.albedo.cwiseProduct(light.sun * (slant * sunlit) +
                                             ambient * (sky * surface.sky_visibility));
  if (surface.reflectivity <= 0) return colour;

  // Schlick's approximation of Fresnel's equations. The reflected surroundings are sky, a dark
  // horizon and the ground.
  const float facing = std::max(-normal.dot(view), 0.f);
  const float grazing = std::pow(1 - facing, 5.f);
  const float mirror = surface.reflectivity + (1 - surface.reflectivity) * 0.8f * grazing;
  const Vec3f out = view - 2 * normal.dot(view) * normal;
  const Vec3f town = 0.22f * light.horizon;
  Vec3f around = Mix(town, ClearSky(light, out.z()), Smooth(0.05f, 0.22f, out.z()));
  around = Mix(GroundLight(light), around, Smooth(-0.06f, 0.02f, out.z()));
  const float glint = std::pow(std::max(out.dot(light.to_sun), 0.f), surface.shininess) *
                      (0.02f * surface.shininess);
  colour +=
      mirror * (around * (0.35f + 0.65f * sky) + light.sun * (sunlit * std::min(glint, 40.f)));
  return colour;
}

Vec3f ApplyHaze(const Daylight& light, const Vec3f& colour, float distance) {
  constexpr float kVisibility = 700;  // distance over which light falls to 1 / e [m]
  return Mix(Vec3f(0.8f * light.horizon), colour, std::exp(-distance / kVisibility));
}

}  // namespace sslcd::render
