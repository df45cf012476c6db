// SPDX-License-Identifier: BSD-3-Clause
#include "formats/pairs.h"

#include <cmath>
#include <limits>
#include <set>
#include <utility>

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

// Adds an object of a row; its id is its number.
void Append(const TextRows& row, std::vector<LayoutObject>& objects) {
  objects.push_back(ParseObject(row));
  objects.back().id = static_cast<int>(objects.size()) - 1;
}

void ExpectCount(std::size_t found, int promised, const std::string& owner, const char* kind,
                 const FileLocation& where) {
  if (found != static_cast<std::size_t>(promised))
    throw Error(ErrorKind::kBadInput, where,
                owner + " announces " + std::to_string(promised) + " " + kind + " rows, but has " +
                    std::to_string(found) + ": is the file truncated?");
}

/// Reads the rows of a file one after the other.
class PairsParser {
 public:
  void Read(const TextRows& row) {
    const std::string_view kind = row.Text(0);
    if (kind == "MAP") {
      StartMap(row);
    } else if (kind == "PAIR") {
      StartPair(row);
    } else if (kind == "G" && file_.map && file_.pairs.empty()) {
      Append(row, *file_.map);
    } else if (kind == "L" || kind == "G") {
      if (file_.pairs.empty()) row.Fail("an object before the first 'PAIR' row");
      LayoutPair& pair = file_.pairs.back();
      Append(row, kind == "L" ? pair.local : pair.global);
    } else {
      row.Fail("a row starts with MAP, PAIR, L or G, not with '" + std::string(kind) + "'");
    }
  }

  LayoutPairFile Finish(const std::string& path) {
    if (file_.pairs.empty())
      throw Error(ErrorKind::kBadInput, {path},
                  "holds no pair: expected 'PAIR id scene n_local n_global yaw tx ty tz'");
    ExpectComplete();
    return std::move(file_);
  }

 private:
  void StartMap(const TextRows& row) {
    if (file_.map || !file_.pairs.empty()) row.Fail("'MAP' is not the first row");
    ExpectColumns(row, 2, "MAP n_global");
    promised_ = {0, row.Integer(1), row.where()};
    if (promised_.global < 0) row.Fail("a negative number of objects");
    file_.map.emplace();
  }

  void StartPair(const TextRows& row) {
    if (file_.map || !file_.pairs.empty()) ExpectComplete();
    ExpectColumns(row, 9, "PAIR id scene n_local n_global yaw tx ty tz");
    LayoutPair pair;
    pair.id = row.Integer(1);
    if (!ids_.insert(pair.id).second) row.Fail("pair " + std::to_string(pair.id) + " comes twice");
    pair.scene = row.Text(2);
    promised_ = {row.Integer(3), row.Integer(4), row.where()};
    if (promised_.local < 0 || promised_.global < 0) row.Fail("a negative number of objects");
    if (file_.map && promised_.global > 0)
      row.Fail("a map of its own after a 'MAP' of all pairs: expected 0 G rows");
    pair.truth.yaw = FiniteNumber(row, 5);
    pair.truth.t = FinitePoint(row, 6);
    file_.pairs.push_back(std::move(pair));
  }

  // The rows of the last map or pair are there.
  void ExpectComplete() const {
    if (file_.pairs.empty()) {
      ExpectCount(file_.map->size(), promised_.global, "the map", "G", promised_.where);
      return;
    }
    const LayoutPair& pair = file_.pairs.back();
    const std::string owner = "pair " + std::to_string(pair.id);
    ExpectCount(pair.local.size(), promised_.local, owner, "L", promised_.where);
    ExpectCount(pair.global.size(), promised_.global, owner, "G", promised_.where);
  }

  struct Counts {
    int local = 0, global = 0;
    FileLocation where;
  };
  LayoutPairFile file_;
  std::set<int> ids_;
  Counts promised_;
};

}  // namespace

LayoutPairFile ReadLayoutPairFile(const std::string& path) {
  TextRows row(path);
  PairsParser parser;
  while (row.Next()) parser.Read(row);
  return parser.Finish(path);
}

std::vector<LayoutPair> ReadLayoutPairs(const std::string& path) {
  LayoutPairFile file = ReadLayoutPairFile(path);
  if (file.map)
    throw Error(ErrorKind::kBadInput, {path}, "has one map for all pairs: expected one for each");
  return std::move(file.pairs);
}

}  // namespace sslcd
