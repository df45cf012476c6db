// SPDX-License-Identifier: BSD-3-Clause
#include "formats/atomic_file.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

#include "formats/files.h"
#include "formats/text_rows.h"
#include "temp_folder.h"

namespace {

namespace fs = std::filesystem;

// What fsync() and rename() were called for; they stand in for those of the C library.
struct Calls {
  std::vector<std::string> names;
  int failing_sync = 0;  // the n-th fsync() fails with EIO
} g_calls;

std::string NameOf(int file) {
  return fs::read_symlink("/proc/self/fd/" + std::to_string(file)).filename().string();
}

}  // namespace

extern "C" int fsync(int file) {
  g_calls.names.push_back("sync " + NameOf(file));
  if (--g_calls.failing_sync != 0) return static_cast<int>(syscall(SYS_fsync, file));
  errno = EIO;
  return -1;
}

extern "C" int rename(const char* from, const char* to) noexcept {
  g_calls.names.push_back("rename " + fs::path(to).filename().string());
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace sslcd {
namespace {

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

TEST(AtomicFile, ItIsOnTheDiskBeforeItHasItsNameAndThenTheNameIs) {
  const TempFolder folder;
  const std::string temporary = ".tmp-" + std::to_string(getpid()),
                    own = fs::path(folder.path()).filename().string();
  g_calls = {};
  WriteFilesAtomically({{folder.In("a"), "1"}, {folder.In("b"), "2"}});
  EXPECT_THAT(g_calls.names, testing::ElementsAre("sync a" + temporary, "sync b" + temporary,
                                                  "rename a", "rename b", "sync " + own));
  g_calls = {};
  WriteFileAtomically(folder.In("a"), "1", Durability::kUnsynced);
  EXPECT_THAT(g_calls.names, testing::ElementsAre("rename a"));
  g_calls = {};
  MakeWritableFolder(folder.In("new/run"));
  EXPECT_THAT(g_calls.names, testing::ElementsAre("sync new", "sync " + own));
}

TEST(AtomicFile, ADiskThatFailsKeepsTheOldFiles) {
  const TempFolder folder;
  WriteFilesAtomically({{folder.In("a"), "old"}, {folder.In("b"), "old"}});
  for (const int failing : {1, 2}) {
    g_calls = {{}, failing};
    ExpectError(
        [&] {
          WriteFilesAtomically({{folder.In("a"), "new"}, {folder.In("b"), "new"}});
        },
        {failing == 1 ? folder.In("a") : folder.In("b"), "cannot be written: "});
    EXPECT_EQ(ReadFileBytes(folder.In("a")), "old");
    EXPECT_EQ(ReadFileBytes(folder.In("b")), "old");
    EXPECT_EQ(FileNames(folder.path()), (std::vector<std::string>{"a", "b"}));
  }
  g_calls = {{}, 3};  // of the folder: the names may be gone after a loss of power
  ExpectError(
      [&] {
        WriteFilesAtomically({{folder.In("a"), "new"}, {folder.In("b"), "new"}});
      },
      {folder.path() + ": cannot be written: "});
}

TEST(AtomicFile, PlacesWhereNoFileCanBe) {
  const TempFolder folder;
  RequirePlaceOf(folder.In("new"));
  RequirePlaceOf("new");  // in the current folder
  EXPECT_FALSE(fs::exists(folder.In("new")));
  ExpectError([&] { RequirePlaceOf(folder.path()); }, {folder.path(), "name a file"});
  ExpectError([&] { RequirePlaceOf(folder.In("no/new")); }, {"no/new", "choose another folder"});
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
