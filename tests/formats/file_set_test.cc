// SPDX-License-Identifier: BSD-3-Clause
#include "formats/file_set.h"

#include "formats/files.h"
#include "formats/text_rows.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using Names = std::vector<std::string>;

TEST(FileSet, FilesAreReplacedAndOthersOfAnEarlierCallRemoved) {
  const TempFolder folder;
  for (const std::string name : {"a", "old", "notes"}) folder.Write(name, "old");
  WriteFileSet({folder.path(),
                "map",
                {{folder.In("a"), "new"}, {folder.In("b"), "new"}},
                {folder.In("old"), folder.In("none")}});
  EXPECT_EQ(FileNames(folder.path()), (Names{"a", "b", "notes"}));
  EXPECT_EQ(ReadFileBytes(folder.In("a")), "new");
  EXPECT_NO_THROW(RefuseUnfinished(folder.path()));
  EXPECT_NO_THROW(RefuseUnfinished(folder.In("none"))) << "the reader of the folder tells that";
}

TEST(FileSet, WhatIsNotFinishedIsRefusedUntilItIsRepeated) {
  const TempFolder folder;
  folder.Write("old/file", "");  // a folder with something in it cannot be removed as a file
  const FileSet set{folder.path(), "map", {{folder.In("a"), "new"}}, {folder.In("old")}};
  ExpectError([&] { WriteFileSet(set); }, {folder.In("old") + ": cannot be removed: "});
  const std::string mark = folder.In(".sslcd-unfinished-map");
  EXPECT_THAT(ReadFileBytes(mark), testing::HasSubstr("two calls"));
  ExpectError(
      [&] { RefuseUnfinished(folder.path()); },
      {folder.path() + ": its files may be of two calls", "repeat the command", "delete " + mark});
  WriteFileSet({folder.path(), "table2", {{folder.In("b"), "new"}}, {}});
  EXPECT_THROW(RefuseUnfinished(folder.path()), Error) << "another set does not mend this one";
  std::filesystem::remove_all(folder.In("old"));
  WriteFileSet(set);
  EXPECT_EQ(FileNames(folder.path()), (Names{"a", "b"}));
  EXPECT_NO_THROW(RefuseUnfinished(folder.path()));
}

TEST(FileSet, WhatCannotBeWrittenLeavesNoMark) {
  const TempFolder folder;
  folder.Write("a", "old");
  const FileSet set{folder.path(), "map", {{folder.In("a"), "new"}, {folder.In("no/b"), ""}}, {}};
  ExpectError([&] { WriteFileSet(set); }, {folder.In("no/b") + ": cannot be written: "});
  EXPECT_EQ(FileNames(folder.path()), (Names{"a"}));
  EXPECT_EQ(ReadFileBytes(folder.In("a")), "old");
}

}  // namespace
}  // namespace sslcd
