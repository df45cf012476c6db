// SPDX-License-Identifier: BSD-3-Clause
#include "formats/file_lock.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <utility>

#include "formats/files.h"
#include "formats/text_rows.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

// Another process that holds the lock of a folder until it is killed.
class Holder {
 public:
  explicit Holder(const std::string& folder) {
    int ready[2];
    if (pipe(ready) != 0) return;
    process_ = fork();
    if (process_ == 0) {
      const FileLock lock = LockFolder(folder);
      if (write(ready[1], "x", 1) == 1) pause();
      _exit(0);
    }
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1);
    close(ready[0]);
    close(ready[1]);
  }
  ~Holder() { Kill(); }
  void Kill() {
    if (process_ > 0) kill(process_, SIGKILL);
    if (process_ > 0) waitpid(process_, nullptr, 0);
    process_ = 0;
  }
  pid_t process() const { return process_; }

 private:
  pid_t process_ = 0;
};

TEST(FileLock, AChildThatIsForkedGivesNothingBack) {
  const TempFolder folder;
  const std::string path = folder.In("run");
  FileLock lock = LockFolder(path);
  const pid_t child = fork();
  if (child == 0) {
    { const FileLock inherited = std::move(lock); }
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(folder.In("run/.sslcd-lock")));
  ExpectError([&] { const FileLock second = LockFolder(path); }, {path + ": is being written by"});
}

TEST(FileLock, ASecondProcessIsToldWhoWritesAndADeadOneIsFollowed) {
  const TempFolder folder;
  const std::string path = folder.In("run"), lock_path = folder.In("run/.sslcd-lock");
  Holder other(path);
  const std::string told = ReadFileBytes(lock_path);
  ExpectError([&] { const FileLock lock = LockFolder(path); },
              {path + ": is being written by process " + std::to_string(other.process()) + " on ",
               " since 20", "sslcd_formats_tests", "wait until it has ended"});
  EXPECT_EQ(ReadFileBytes(lock_path), told) << "the holder's file is left alone";
  other.Kill();
  EXPECT_TRUE(fs::exists(lock_path)) << "a killed process leaves its file";
  {
    const FileLock lock = LockFolder(path);
    EXPECT_THAT(ReadFileBytes(lock_path),
                testing::HasSubstr("process " + std::to_string(getpid()) + " on "));
  }
  EXPECT_TRUE(fs::is_empty(path)) << "no litter";
}

TEST(FileLock, ItIsGivenBackOnceAndMoves) {
  const TempFolder folder;
  std::optional<FileLock> outer;
  {
    FileLock lock = LockFolder(folder.path());
    outer.emplace(std::move(lock));
  }
  ExpectError([&] { const FileLock lock = LockFolder(folder.path()); },
              {"is being written by process"});
  outer.reset();
  const FileLock again = LockFolder(folder.path());
}

TEST(FileLock, NoLinkIsFollowedAndWhatCannotBeLockedIsNamed) {
  const TempFolder folder;
  folder.Write("other", "not to be touched");
  fs::create_symlink("other", folder.In(".sslcd-lock"));
  ExpectError([&] { const FileLock lock = LockFolder(folder.path()); },
              {".sslcd-lock: cannot be made"});
  EXPECT_EQ(ReadFileBytes(folder.In("other")), "not to be touched");
  ExpectError([&] { const FileLock lock(folder.In("none/lock"), "map", "wait"); },
              {"none/lock: cannot be made", "must exist"});
}

TEST(FileLock, AFolderWithALockAloneIsEmpty) {
  const TempFolder folder;
  EXPECT_TRUE(IsEmptyFolder(folder.path()));
  const FileLock lock = LockFolder(folder.path());
  EXPECT_TRUE(IsEmptyFolder(folder.path()));
  folder.Write("notes.txt", "");
  EXPECT_FALSE(IsEmptyFolder(folder.path()));
  ExpectError([&] { IsEmptyFolder(folder.In("none")); }, {"none: No such file"});
}

}  // namespace
}  // namespace sslcd
