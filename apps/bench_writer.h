// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bench_tables.h"
#include "benchmark/table.h"

namespace sslcd::apps {

/// Prints the tables of a benchmark, and writes them into its result folder and a document. Refers
/// to both arguments.
class TableWriter {
 public:
  TableWriter(const BenchArguments& arguments, const Console& console)
      : arguments_(arguments), console_(console) {}

  /// As Markdown, JSON and CSV, with its provenance below. `cases` of HALV-sim that were run; none:
  /// the table is not about HALV-sim. `curves` belong to it, and are written as CSV alone. All of
  /// them are a FileSet.
  void Write(benchmark::Table table, const std::vector<int>& cases,
             const std::vector<benchmark::Table>& curves = {});

  /// Throws Error if there is a document (--docs) that cannot be read, or a page (--report) without
  /// its libraries, that cannot be written, or that would overwrite an input.
  void CheckPlaces() const;
  /// Puts all tables written so far into the document, and writes the page, if they are asked for.
  BenchResults Finish();

 private:
  std::string Provenance(const std::vector<int>& cases) const;

  const BenchArguments& arguments_;
  const Console& console_;
  BenchResults results_;
};

}  // namespace sslcd::apps
