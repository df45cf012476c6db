// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_kml.h"

#include <cmath>

#include "formats/number_text.h"
#include "report/markup.h"
#include "run_export/run_geojson.h"

namespace sslcd {
namespace {

std::string Tag(const char* name, const std::string& content) {
  return std::string("<") + name + ">" + content + "</" + name + ">";
}

std::string TextTag(const char* name, const std::string& text) {
  return Tag(name, MarkupText(text));
}

// aabbggrr
std::string KmlColour(Colour colour) {
  return Tag("color", "ff" + Hex({colour.blue, colour.green, colour.red}).substr(1));
}

std::string Coordinates(const std::vector<GeoPoint>& points) {
  std::string text;
  for (const GeoPoint& point : points) {
    text += (text.empty() ? "" : " ") + ShortestNumber(point.longitude_deg) + "," +
            ShortestNumber(point.latitude_deg);
    if (point.altitude_m) text += "," + ShortestNumber(*point.altitude_m);
  }
  return Tag("coordinates", text);
}

std::string Placemark(const std::string& name, const std::string& description,
                      const std::string& style, const std::string& geometry) {
  return Tag("Placemark", TextTag("name", name) +
                              (description.empty() ? "" : TextTag("description", description)) +
                              Tag("Style", style) + geometry) +
         "\n";
}

std::string Folder(const std::string& name, const std::string& content) {
  return content.empty() ? "" : Tag("Folder", TextTag("name", name) + "\n" + content) + "\n";
}

std::string Line(const std::string& name, const std::string& description, Colour colour, int width,
                 const std::vector<Vec3>& positions, const GeoPlane& plane) {
  std::vector<GeoPoint> points;
  for (const Vec3& position : positions) points.push_back(plane.At(position));
  if (points.size() == 1) points.push_back(points[0]);
  const bool has_altitude = points[0].altitude_m.has_value();
  return Placemark(
      name, description, Tag("LineStyle", KmlColour(colour) + Tag("width", std::to_string(width))),
      Tag("LineString", Tag("tessellate", has_altitude ? "0" : "1") +
                            Tag("altitudeMode", has_altitude ? "absolute" : "clampToGround") +
                            Coordinates(points)));
}

// The top of the object, with walls down to the ground.
std::string Polygon(const RunScene::Object& each, const GeoPlane& plane) {
  const Vec3& dims = each.object.dims;
  std::vector<GeoPoint> ring = OutlineOf(each, plane);
  ring.push_back(ring[0]);
  for (GeoPoint& point : ring) point.altitude_m = std::round(dims.z() * 1e3) / 1e3;
  return Placemark(
      each.name,
      "sightings: " + std::to_string(each.object.observations.size()) +
          "; size: " + FixedNumber(dims.x(), 1) + " x " + FixedNumber(dims.y(), 1) + " x " +
          FixedNumber(dims.z(), 1) + " m",
      Tag("LineStyle", KmlColour(each.colour)) + Tag("PolyStyle", KmlColour(each.colour)),
      Tag("Polygon", Tag("extrude", "1") + Tag("altitudeMode", "relativeToGround") +
                         Tag("outerBoundaryIs", Tag("LinearRing", Coordinates(ring)))));
}

std::string Objects(const RunScene& scene, const GeoPlane& plane) {
  std::string all, members;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {  // sorted by label
    members += Polygon(scene.objects[i], plane);
    const std::string& label = scene.objects[i].object.label;
    if (i + 1 < scene.objects.size() && scene.objects[i + 1].object.label == label) continue;
    all += Folder(label, members);
    members.clear();
  }
  return Folder("objects", all);
}

std::string DescriptionOf(const LoopClosure& loop) {
  return "viewpoint change: " + FixedNumber(loop.viewpoint_change_rad * 180 / M_PI, 0) +
         " degrees; matched objects: " + std::to_string(loop.pairs.size()) +
         (loop.probability ? "; probability: " + FixedNumber(*loop.probability, 4) : "");
}

}  // namespace

std::string RunKml(const RunScene& scene, const GeoOrigin& origin) {
  const GeoPlane plane(origin, scene.T_world_first, scene.gravity.up);
  std::string paths, loops;
  for (const RunScene::Path& path : scene.paths)
    paths += Line(path.name, "", path.colour, 3, path.points, plane);
  for (const RunScene::Loop& loop : scene.loops)
    loops +=
        Line(loop.name, DescriptionOf(loop.loop), loop.colour, 2, {loop.match, loop.query}, plane);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n" +
         Tag("Document", TextTag("name", scene.name) + "\n" + Folder("paths", paths) +
                             Objects(scene, plane) + Folder("loops", loops)) +
         "\n</kml>\n";
}

}  // namespace sslcd
