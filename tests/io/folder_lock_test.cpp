#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/process_mark.hpp>
#include <gracilis/io/run/folder_lock.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <io/tiny_run.hpp>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>

using namespace gracilis;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace {

std::string refusal(const fs::path& folder) {
  try {
    const FolderLock lock(folder);
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  ADD_FAILURE() << "the folder could be locked";
  return "";
}

/// The mark of a process of this machine that has ended.
ProcessMark ended() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  ProcessMark mark = own_mark();
  mark.process = child;
  return mark;
}

}  // namespace

TEST(FolderLock, keeps_others_out_and_says_who_is_in) {
  const TestFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_THAT(refusal(folder.path()), HasSubstr("is being written by process " + std::to_string(getpid())));
  }
  const FolderLock again(folder.path());
}

TEST(FolderLock, leaves_nothing_behind) {
  const TestFolder folder;
  { const FolderLock lock(folder.path()); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderLock, that_of_a_killed_process_is_taken_over) {
  const TestFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    (void)!write(ready[1], "x", 1);
    pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THAT(refusal(folder.path()), HasSubstr("process " + std::to_string(child)));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(folder.path() / "run.lock"));
  const FolderLock lock(folder.path());
}

TEST(FolderLock, that_of_another_machine_is_respected) {
  const TestFolder folder;
  folder.write("run.lock", "elsewhere 123 456\n");
  EXPECT_THAT(refusal(folder.path()), HasSubstr("process 123 on elsewhere"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("remove " + (folder.path() / "run.lock").string()));
}

TEST(FolderLock, two_runs_never_write_to_one_folder) {
  const TestFolder folder;
  const TinyRun run;
  RunFolder first(folder.path() / "run", run.scene, run.poses, ExistingRun::refuse);
  for (const ExistingRun existing : {ExistingRun::refuse, ExistingRun::replace, ExistingRun::resume})
    EXPECT_THROW(RunFolder(folder.path() / "run", run.scene, run.poses, existing), ConfigurationError);
  first.write_frame(run.record(0));
  EXPECT_EQ(count_frames(first.path(), run.scene), 1);
}

TEST(ProcessMark, tells_living_processes_from_dead_ones_and_their_successors) {
  EXPECT_FALSE(is_gone(own_mark()));
  EXPECT_TRUE(is_gone(ended()));
  ProcessMark successor = own_mark();
  ASSERT_GT(successor.started, 0);
  successor.started -= 1;
  EXPECT_TRUE(is_gone(successor)) << "this process has the number of one that ended";
  EXPECT_FALSE(is_gone({"elsewhere", 1, 1}));
  EXPECT_FALSE(parse_mark("host -1 5").has_value());
  EXPECT_FALSE(parse_mark("host 99999999999999 5").has_value());
}

TEST(ProcessMark, of_a_process_that_has_ended_and_nobody_has_waited_for_is_gone) {
  ProcessMark mark = own_mark();
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t how;
  waitid(P_PID, static_cast<id_t>(child), &how, WEXITED | WNOWAIT);
  mark.process = child;
  mark.started = 0;  // so that its beginning tells nothing
  EXPECT_TRUE(is_gone(mark));
  waitpid(child, nullptr, 0);
}

TEST(ProcessMark, of_a_process_that_ends_while_it_is_asked_for_is_no_error) {
  std::atomic<pid_t> process = getpid();
  std::atomic<bool> done = false;
  std::thread begins([&] {
    for (int i = 0; i < 300; ++i) {
      const pid_t child = fork();
      if (child == 0) _exit(0);
      process = child;
      waitpid(child, nullptr, 0);
    }
    done = true;
  });
  ProcessMark mark = own_mark();
  int errors = 0;
  while (!done) {
    mark.process = process;
    try {
      (void)is_gone(mark);
    } catch (const std::exception&) {
      ++errors;
    }
  }
  begins.join();
  EXPECT_EQ(errors, 0);
}

/// What a temporary of this process is called.
static std::string temporary_of(const ProcessMark& mark, const std::string& ending) {
  return ".gracilis-" + mark.host + "-" + std::to_string(mark.process) + "-" + std::to_string(mark.started) + ending;
}

TEST(AtomicFile, temporaries_of_killed_processes_are_removed_and_no_others) {
  const TestFolder folder;
  const ProcessMark dead = ended(), own = own_mark();
  const auto name = [](const ProcessMark& mark) { return temporary_of(mark, "-0.vtp"); };
  folder.write(name(dead), "half");
  folder.write(name(own), "being written");
  folder.write(name({"elsewhere", 1, 1}), "perhaps being written");
  folder.write(".gracilis-mine", "no temporary");
  remove_left_temporaries(folder.path(), LeftBy::own_machine);
  EXPECT_FALSE(fs::exists(folder.path() / name(dead)));
  EXPECT_TRUE(fs::exists(folder.path() / name({"elsewhere", 1, 1})));
  remove_left_temporaries(folder.path(), LeftBy::any_machine);
  EXPECT_FALSE(fs::exists(folder.path() / name({"elsewhere", 1, 1})));
  EXPECT_TRUE(fs::exists(folder.path() / name(own)));
  EXPECT_TRUE(fs::exists(folder.path() / ".gracilis-mine"));
}

TEST(AtomicFile, a_run_that_is_gone_on_with_keeps_no_temporaries) {
  const TestFolder folder;
  TinyRun run;
  run.scene.method.contact["muscle"] = "none";
  {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::refuse);
    for (int i = 0; i < 2; ++i) out.write_frame(run.record(i));
  }
  const ProcessMark dead = ended();
  const std::string name =
      ".gracilis-" + dead.host + "-" + std::to_string(dead.process) + "-" + std::to_string(dead.started) + "-0.vtp";
  folder.write("frames/" + name, "half");
  RunFolder(folder.path(), run.scene, run.poses, ExistingRun::resume);
  EXPECT_FALSE(fs::exists(folder.path() / "frames" / name));
}

TEST(AtomicFile, a_link_in_the_way_of_a_temporary_is_never_followed) {
  const TestFolder folder;
  const fs::path victim = folder.write("victim.txt", "untouched");
  const ProcessMark own = own_mark();
  // Temporaries are numbered: links lie where the next ones of any test so far would be.
  for (int i = 0; i < 3000; ++i)
    fs::create_symlink(victim, folder.path() / (".gracilis-" + own.host + "-" + std::to_string(own.process) + "-" +
                                                std::to_string(own.started) + "-" + std::to_string(i) + ".txt"));
  write_text_atomically(folder.path() / "a.txt", "new");
  EXPECT_EQ(content(victim), "untouched");
  EXPECT_EQ(content(folder.path() / "a.txt"), "new");
  EXPECT_FALSE(fs::is_symlink(folder.path() / "a.txt"));
}

TEST(AtomicFile, what_is_no_file_is_never_replaced_by_one) {
  const TestFolder folder;
  const fs::path pipe = folder.path() / "pipe.txt", device = folder.path() / "device.txt",
                 part = folder.path() / "part";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("/dev/null", device);
  fs::create_directory(part);
  for (const fs::path& path : {pipe, device, part}) {
    try {
      write_text_atomically(path, "text");
      ADD_FAILURE() << path << " was replaced";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string() + ": is no file that could be replaced")) << path;
    }
  }
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_TRUE(fs::is_symlink(device));
  EXPECT_TRUE(fs::is_directory(part));
}

TEST(AtomicFile, what_killed_processes_left_goes_with_the_first_file_that_is_written_beside_it) {
  const TestFolder folder;
  const ProcessMark dead = ended(), own = own_mark();
  const auto name = [](const ProcessMark& mark) { return temporary_of(mark, "-99999.csv"); };
  folder.write(name(dead), "half");
  folder.write(name(own), "being written");
  write_text_atomically(folder.path() / "a.txt", "whole");
  EXPECT_FALSE(fs::exists(folder.path() / name(dead)));
  EXPECT_TRUE(fs::exists(folder.path() / name(own)));
}
