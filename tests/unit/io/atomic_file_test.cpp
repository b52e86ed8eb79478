// SPDX-FileCopyrightText: The Rondel authors
// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "unit/io/support.h"

namespace rondel::test {
namespace {

using io::AtomicFile;

TEST(atomic_file, appears_complete) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.txt");
  std::string expected;
  AtomicFile file(path);
  for (int i = 0; i < 100; ++i) {
    const std::string part(static_cast<std::size_t>(i) * 7919, static_cast<char>('a' + i % 26));
    file.write(part);
    expected += part;
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  file.commit();
  EXPECT_EQ(read_all(path), expected);
  EXPECT_EQ(directory.num_files(), 1U);
}

TEST(atomic_file, appears_together_with_others_or_not_at_all) {
  const TemporaryDirectory directory;
  const auto write = [&](const char* name) { write_file(directory.file(name), name); };
  write("a.txt");
  {
    const FilesTogether files;
    write_file(directory.file("a.txt"), "other");
    write("b.txt");
    EXPECT_THROW(write_file(directory.file("none/c.txt"), "c"), FileError);
  }
  EXPECT_EQ(read_all(directory.file("a.txt")), "a.txt");
  EXPECT_EQ(directory.num_files(), 1U);
  {
    FilesTogether files;
    write_file(directory.file("a.txt"), "other");
    {
      FilesTogether inner;
      write("b.txt");
      inner.commit();
    }
    EXPECT_EQ(directory.num_files(), 1U);
    files.commit();
    EXPECT_EQ(read_all(directory.file("a.txt")), "other");
    EXPECT_EQ(read_all(directory.file("b.txt")), "b.txt");
    write("c.txt");
    EXPECT_EQ(directory.num_files(), 3U);
  }
  EXPECT_EQ(directory.num_files(), 3U);
}

TEST(atomic_file, a_string_gets_the_bytes_of_the_file_at_the_end) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.npy");
  std::string bytes = "before";
  {
    AtomicFile file(FileName::in_memory(bytes, "npy"));
    file.reserve(9);
    file.expect(7);
    file.write("text");
    EXPECT_TRUE(file.is_direct());
  }
  EXPECT_EQ(bytes, "before");
  const std::vector<Index> values(100'000, 7);
  const std::array<std::uint64_t, 1> shape = {values.size()};
  write_indices(path, values, shape);
  write_indices(FileName::in_memory(bytes, "npy"), values, shape);
  EXPECT_EQ(bytes, read_all(path));
}

TEST(atomic_file, a_string_is_read_like_a_file) {
  std::string bytes = "lon,lat\n1,2\n3,4\n";
  const SiteTable table = read_sites(FileName::in_memory(bytes, "csv", "places"));
  EXPECT_EQ(table.sites.size(), 2U);
  EXPECT_EQ(table.where(1), "places:3");
  std::string empty;
  EXPECT_THROW(read_sites(FileName::in_memory(empty, "csv")), FileError);
}

TEST(atomic_file, is_closed_whatever_becomes_of_it) {
  const TemporaryDirectory directory;
  const auto num_open = [] {
    const std::filesystem::directory_iterator open("/proc/self/fd");
    return std::distance(begin(open), end(open));
  };
  const auto before = num_open();
  for (int round = 0; round < 3; ++round) {
    AtomicFile file(directory.file("a.txt"));
    EXPECT_EQ(num_open(), before + 1);
    file.write("text");
    if (round > 0) file.commit();
  }
  EXPECT_EQ(num_open(), before);
}

TEST(atomic_file, has_the_length_that_is_written_not_the_expected_one) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("a.txt");
  for (const std::uint64_t size : {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{1} << 20U}) {
    AtomicFile file(path);
    file.expect(size);
    file.write("content");
    file.commit();
    EXPECT_EQ(read_all(path), "content");
  }
  AtomicFile direct("/dev/null");
  direct.expect(1U << 20U);
  direct.write("content");
  direct.commit();
#if defined(__linux__)
  AtomicFile endless(path);
  EXPECT_THROW(endless.expect(std::uint64_t{1} << 62U), FileError);
#endif
  EXPECT_EQ(read_all(path), "content");
  EXPECT_EQ(directory.num_files(), 1U);
}

TEST(atomic_file, leaves_everything_as_it_was_when_abandoned) {
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  { AtomicFile(path).write("after"); }
  EXPECT_EQ(read_all(path), "before");
  EXPECT_EQ(directory.num_files(), 1U);
}

TEST(atomic_file, has_the_permissions_of_a_new_file) {
  const TemporaryDirectory directory;
  const mode_t mask = ::umask(0027);
  write_file(directory.file("a.txt"), "x");
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::stat(directory.file("a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

mode_t mode_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 0777U;
}

TEST(atomic_file, keeps_the_permissions_of_the_file_that_it_replaces) {
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  for (const mode_t mode : {0600U, 0640U, 0666U, 0755U}) {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    write_file(path, "after");
    EXPECT_EQ(mode_of(path), mode);
  }
}

TEST(atomic_file, keeps_owner_and_group_where_it_may) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs the right to give files away";
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  ASSERT_EQ(::chown(path.c_str(), 1234, 4321), 0);
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  write_file(path, "after");
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 1234U);
  EXPECT_EQ(status.st_gid, 4321U);
  EXPECT_EQ(mode_of(path), 0640U);
}

// The file has no name yet: its permissions are those of what this process has open.
TEST(atomic_file, is_never_more_readable_than_the_file_that_it_replaces) {
  const TemporaryDirectory directory;
  const std::string path = directory.with("private.txt", "before");
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  AtomicFile file(path);
  file.write(std::string(1 << 20, 'x'));
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const std::string name = std::filesystem::read_symlink(entry.path(), error);
    if (!name.starts_with(directory.file(""))) continue;
    ++seen;
    EXPECT_EQ(mode_of(entry.path()), 0600U);
  }
  EXPECT_EQ(seen, 1);
  file.commit();
  EXPECT_EQ(mode_of(path), 0600U);
}

TEST(atomic_file, makes_what_a_link_points_to) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.file("folder"));
  std::filesystem::create_symlink("folder/b", directory.file("a"));
  std::filesystem::create_symlink("../c", directory.file("folder/b"));
  write_file(directory.file("a"), "x");
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file("a")));
  EXPECT_FALSE(std::filesystem::is_symlink(directory.file("c")));
  EXPECT_EQ(read_all(directory.file("c")), "x");
  std::filesystem::create_symlink("none/d", directory.file("d"));
  EXPECT_EQ(message_of([&] { write_file(directory.file("d"), "x"); }),
            directory.file("d") + ": No such file or directory");
  std::filesystem::create_symlink("e", directory.file("e"));
  EXPECT_EQ(message_of([&] { write_file(directory.file("e"), "x"); }),
            directory.file("e") + ": Too many levels of symbolic links");
}

TEST(atomic_file, other_names_keep_the_old_content) {
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  std::filesystem::create_hard_link(path, directory.file("b.txt"));
  write_file(path, "after");
  EXPECT_EQ(read_all(directory.file("b.txt")), "before");
}

TEST(atomic_file, refuses_a_file_that_may_not_be_written) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  ASSERT_EQ(::chmod(path.c_str(), 0444), 0);
  EXPECT_EQ(message_of([&] { write_file(path, "x"); }), path + ": Permission denied");
}

TEST(atomic_file, replaces_what_a_link_points_to) {
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  std::filesystem::create_symlink("a.txt", directory.file("link"));
  write_file(directory.file("link"), "after");
  EXPECT_TRUE(std::filesystem::is_symlink(directory.file("link")));
  EXPECT_EQ(read_all(path), "after");
}

TEST(atomic_file, takes_a_name_as_long_as_a_name_can_be) {
  const TemporaryDirectory directory;
  const std::string path = directory.file(std::string(255, 'n'));
  write_file(path, "x");
  EXPECT_EQ(read_all(path), "x");
}

TEST(atomic_file, says_why_it_cannot_be_written) {
  const TemporaryDirectory directory;
  const std::string nowhere = directory.file("none/a.txt");
  EXPECT_EQ(message_of([&] { write_file(nowhere, "x"); }), nowhere + ": No such file or directory");
  const std::string folder = directory.file("folder");
  std::filesystem::create_directory(folder);
  EXPECT_EQ(message_of([&] { write_file(folder, "x"); }), folder + ": Is a directory");
  EXPECT_EQ(directory.num_files(), 1U);
}

TEST(atomic_file, says_that_the_disk_is_full) {
  const TemporaryDirectory directory;
  const std::string link = directory.file("out.geojson");
  std::filesystem::create_symlink("/dev/full", link);
  const std::string large(1 << 20, 'x');
  EXPECT_EQ(message_of([&] { write_file(link, "small"); }), link + ": No space left on device");
  EXPECT_EQ(message_of([&] { write_file(link, large); }), link + ": No space left on device");
}

// Runs `action` in a process of its own and returns how it ended.
template <typename Action>
int status_of(Action action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(atomic_file, leaves_nothing_when_a_write_fails) {
  const TemporaryDirectory directory;
  const std::string path = directory.with("a.txt", "before");
  const int status = status_of([&] {
    std::signal(SIGXFSZ, SIG_IGN);  // so that the limit is an error and no signal
    const rlimit limit = {100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = message_of([&] { write_file(path, std::string(1 << 20, 'x')); });
    ::_exit(message == path + ": File too large" ? 0 : 1);
  });
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(read_all(path), "before");
  EXPECT_EQ(directory.num_files(), 1U);
}

TEST(atomic_file, leaves_nothing_when_a_signal_ends_the_process) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    const TemporaryDirectory directory;
    const int status = status_of([&] {
      std::signal(signal, [](int number) {
        remove_temporaries();
        std::signal(number, SIG_DFL);
        ::raise(number);
      });
      AtomicFile first(directory.file("a.txt"));
      AtomicFile second(directory.file("b.txt"));
      first.write(std::string(1 << 20, 'x'));
      ::raise(signal);
    });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    EXPECT_EQ(directory.num_files(), 0U);
  }
}

}  // namespace
}  // namespace rondel::test
