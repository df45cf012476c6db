// SPDX-License-Identifier: BSD-3-Clause
#include "formats/pairs.h"

#include <cmath>
#include <limits>
#include <set>

#include "formats/text_rows.h"

namespace sslcd {
namespace {

double FiniteNumber(const TextRows& row, std::size_t column) {
  const double value = row.Number(column);
  if (!std::isfinite(value))
    row.Fail("column " + std::to_string(column + 1) + " is '" + std::string(row.Text(column)) +
             "', expected a finite number: leave out values that were not measured");
  return value;
}

Vec3 FinitePoint(const TextRows& row, std::size_t column) {
  return {FiniteNumber(row, column), FiniteNumber(row, column + 1), FiniteNumber(row, column + 2)};
}

void ExpectColumns(const TextRows& row, std::size_t columns, const char* layout) {
  if (row.size() != columns)
    row.Fail("found " + std::to_string(row.size()) + " columns, expected '" + layout + "'");
}

LayoutObject ParseObject(const TextRows& row) {
  ExpectColumns(row, 6, "L|G identity label x y z");
  row.Integer(1);  // the true identity: checked and dropped
  LayoutObject object;
  object.label = row.Integer(2);
  if (object.label < 0) row.Fail("label " + std::to_string(object.label) + ": labels count from 0");
  object.position = FinitePoint(row, 3);
  object.yaw = std::numeric_limits<double>::quiet_NaN();
  return object;
}

struct Counts {
  int local = 0, global = 0;
  FileLocation where;
};

void ExpectComplete(const LayoutPair& pair, const Counts& promised) {
  const auto check = [&](std::size_t found, int expected, const char* kind) {
    if (found != static_cast<std::size_t>(expected))
      throw Error(ErrorKind::kBadInput, promised.where,
                  "pair " + std::to_string(pair.id) + " announces " + std::to_string(expected) +
                      " " + kind + " rows, but has " + std::to_string(found) +
                      ": is the file truncated?");
  };
  check(pair.local.size(), promised.local, "L");
  check(pair.global.size(), promised.global, "G");
}

}  // namespace

std::vector<LayoutPair> ReadLayoutPairs(const std::string& path) {
  TextRows row(path);
  std::vector<LayoutPair> pairs;
  std::set<int> ids;
  Counts promised;
  while (row.Next()) {
    const std::string_view kind = row.Text(0);
    if (kind == "PAIR") {
      if (!pairs.empty()) ExpectComplete(pairs.back(), promised);
      ExpectColumns(row, 9, "PAIR id scene n_local n_global yaw tx ty tz");
      LayoutPair pair;
      pair.id = row.Integer(1);
      if (!ids.insert(pair.id).second) row.Fail("pair " + std::to_string(pair.id) + " comes twice");
      pair.scene = row.Text(2);
      promised = {row.Integer(3), row.Integer(4), row.where()};
      if (promised.local < 0 || promised.global < 0) row.Fail("a negative number of objects");
      pair.truth.yaw = FiniteNumber(row, 5);
      pair.truth.t = FinitePoint(row, 6);
      pairs.push_back(pair);
    } else if (kind == "L" || kind == "G") {
      if (pairs.empty()) row.Fail("an object before the first 'PAIR' row");
      std::vector<LayoutObject>& objects = kind == "L" ? pairs.back().local : pairs.back().global;
      objects.push_back(ParseObject(row));
      objects.back().id = static_cast<int>(objects.size()) - 1;
    } else {
      row.Fail("a row starts with PAIR, L or G, not with '" + std::string(kind) + "'");
    }
  }
  if (pairs.empty())
    throw Error(ErrorKind::kBadInput, {path},
                "holds no pair: expected 'PAIR id scene n_local n_global yaw tx ty tz'");
  ExpectComplete(pairs.back(), promised);
  return pairs;
}

}  // namespace sslcd
