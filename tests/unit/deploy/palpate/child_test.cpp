#include "deploy/palpate/child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

namespace palpate::deploy {
namespace {

const std::filesystem::path shell = "/bin/sh";

TEST(Child, TellsItsExitCode) {
  Child child(shell, {"-c", "exit 3"});
  EXPECT_EQ(child.wait().text(), "ended with exit code 3");
  EXPECT_FALSE(child.wait().clean());
  EXPECT_TRUE(Child(shell, {"-c", "exit 0"}).wait().clean());
}

TEST(Child, TellsTheSignalThatEndedIt) {
  Child child("/bin/sleep", {"60"});
  EXPECT_FALSE(child.ending());
  child.signal(SIGKILL);
  EXPECT_EQ(child.wait().text(), "was ended by signal 9 (SIGKILL, Killed)");
}

TEST(Child, IsNotLeftBehind) {
  pid_t pid = 0;
  {
    const Child child("/bin/sleep", {"60"});
    pid = child.pid();
    EXPECT_EQ(kill(pid, 0), 0);
  }
  EXPECT_NE(kill(pid, 0), 0);
}

TEST(Child, LeadsAProcessGroupOfItsOwn) {
  const Child child("/bin/sleep", {"60"});
  EXPECT_EQ(getpgid(child.pid()), child.pid());
}

TEST(Child, InheritsNoOpenFileButTheThreeStandardOnes) {
  const int open_here = dup2(STDERR_FILENO, 57);
  ASSERT_EQ(open_here, 57);
  EXPECT_TRUE(Child(shell, {"-c", "test ! -e /proc/self/fd/57"}).wait().clean());
  close(open_here);
}

TEST(Child, EndsWith127WhenThereIsNoSuchProgram) {
  EXPECT_EQ(Child("/no/such/program", {}).wait().code, 127);
}

}  // namespace
}  // namespace palpate::deploy
