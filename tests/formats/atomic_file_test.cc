// SPDX-License-Identifier: BSD-3-Clause
#include "formats/atomic_file.h"

#include <unistd.h>

#include "formats/text_rows.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, AFullDiskLeavesTheOldFileAlone) {
  const TempFolder folder;
  EXPECT_THROW(WriteFileAtomically("/dev/full", "text"), Error);
  EXPECT_TRUE(fs::is_character_file("/dev/full")) << "a device must not be renamed away";
  WriteFileAtomically(folder.In("file"), "old");
  fs::create_directory(folder.In("file2"));
  EXPECT_THROW(WriteFileAtomically(folder.In("file2"), "new"), Error);
  EXPECT_THROW(WriteFileAtomically(folder.In("file/below"), "new"), Error);
  EXPECT_EQ(ReadFileBytes(folder.In("file")), "old");
}

TEST(AtomicFile, OfSeveralFilesAllAreWrittenOrNone) {
  const TempFolder folder;
  fs::create_directory(folder.In("folder"));
  WriteFileAtomically(folder.In("a"), "old");
  EXPECT_THROW(WriteFilesAtomically({{folder.In("a"), "new"}, {folder.In("folder"), "new"}}),
               Error);
  EXPECT_THROW(WriteFilesAtomically({{folder.In("a"), "new"}, {folder.In("none/b"), "new"}}),
               Error);
  EXPECT_EQ(ReadFileBytes(folder.In("a")), "old");
  WriteFilesAtomically({{folder.In("a"), "new"}, {folder.In("b"), "too"}});
  EXPECT_EQ(ReadFileBytes(folder.In("a")), "new");
  EXPECT_EQ(ReadFileBytes(folder.In("b")), "too");
  for (const auto& entry : fs::directory_iterator(folder.In("")))
    EXPECT_THAT(entry.path().filename().string(), testing::Not(testing::HasSubstr("tmp")))
        << "nothing is left behind";
}

TEST(AtomicFile, NoLinkIsFollowedAndNoLitterOfKilledProgramsStays) {
  const TempFolder folder;
  const std::string own = std::to_string(getpid()), gone = "4194304";  // above the largest number
  folder.Write("other", "not to be touched");
  fs::create_symlink("other", folder.In("a.tmp-" + own));
  for (const std::string& name : {"a.tmp-" + gone, std::string("a.tmp-1"), std::string("a.tmp-x")})
    folder.Write(name, "");
  WriteFileAtomically(folder.In("a"), "new");
  EXPECT_EQ(ReadFileBytes(folder.In("a")), "new");
  EXPECT_EQ(ReadFileBytes(folder.In("other")), "not to be touched");
  EXPECT_FALSE(fs::exists(folder.In("a.tmp-" + gone)));
  EXPECT_TRUE(fs::exists(folder.In("a.tmp-1"))) << "that one runs";
  EXPECT_TRUE(fs::exists(folder.In("a.tmp-x"))) << "not ours";
}

TEST(AtomicFile, FoldersThatCannotBe) {
  const TempFolder folder;
  WriteFileAtomically(folder.In("file"), "x");
  try {
    MakeWritableFolder(folder.In("file/run"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kOutput);
    EXPECT_THAT(error.what(), testing::HasSubstr("file/run: cannot be written"));
  }
  EXPECT_THROW(MakeWritableFolder("/proc/sslcd"), Error);
}

}  // namespace
}  // namespace sslcd
