// Who gets a claim, and how long it counts.
#include "base/claim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "base/error.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool is_taken(const std::variant<Claim, ClaimHolder>& answer) { return std::holds_alternative<Claim>(answer); }

class ClaimTest : public testing::Test {
 protected:
  // What a child that runs `work` ends with; it ends without destructors, as one that is killed.
  static int status_of_child(const std::function<bool()>& work) {
    const pid_t child = fork();
    if (child == 0) _exit(work() ? 0 : 1);
    int status = 0;
    waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  }

  void leave_claim_of_dead_child() {
    ASSERT_EQ(status_of_child([&] {
                const auto claim = take_claim(file_);
                if (!is_taken(claim)) return false;
                _exit(0);
              }),
              0);
    ASSERT_TRUE(fs::exists(file_));
  }

  // The claim as another machine would have written it, so long ago.
  void move_to_another_machine(std::chrono::seconds age) {
    std::string text = test::read_text(file_);
    for (const std::string key : {"host: ", "space: "}) text.insert(text.find(key) + key.size(), "other-");
    std::ofstream(file_) << text;
    fs::last_write_time(file_, fs::file_time_type::clock::now() - age);
  }

  std::vector<std::string> names_left() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.push_back(entry.path().filename());
    return names;
  }

  const test::TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "claim";
};

TEST_F(ClaimTest, IsHeldByOneUntilItIsLetGo) {
  {
    const auto first = take_claim(file_);
    ASSERT_TRUE(is_taken(first));
    const auto second = take_claim(file_);
    ASSERT_FALSE(is_taken(second));
    const auto& holder = std::get<ClaimHolder>(second);
    EXPECT_EQ(holder.process, getpid());
    EXPECT_TRUE(holder.is_near);
    EXPECT_THAT(holder.since, testing::EndsWith(" UTC"));
    EXPECT_EQ(claim_holder(file_)->process, getpid());
    EXPECT_TRUE(std::get<Claim>(first).renew());
    EXPECT_EQ(names_left(), std::vector<std::string>{"claim"});
  }
  EXPECT_FALSE(claim_holder(file_));
  EXPECT_TRUE(names_left().empty());
  EXPECT_TRUE(is_taken(take_claim(file_)));
}

TEST_F(ClaimTest, OfADeadProcessIsTakenOver) {
  leave_claim_of_dead_child();
  EXPECT_FALSE(claim_holder(file_));
  EXPECT_TRUE(is_taken(take_claim(file_)));
}

// It cannot be waited for by another than its parent, and has not let go of its number.
TEST_F(ClaimTest, OfAProcessThatHasEndedButIsNotReapedIsTakenOver) {
  const pid_t child = fork();
  if (child == 0) {
    const auto claim = take_claim(file_);
    _exit(0);
  }
  siginfo_t info = {};
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_TRUE(is_taken(take_claim(file_)));
  waitpid(child, nullptr, 0);
}

// Its number may have been given to another process.
TEST_F(ClaimTest, OfANumberThatIsAnotherProcessByNowIsTakenOver) {
  {
    std::ofstream held(file_);
    const auto claim = take_claim(folder_.path() / "other");
    const std::string text = test::read_text(folder_.path() / "other");
    held << test::read_text(folder_.path() / "other").replace(text.find("started: "), 9, "started: 1");
  }
  EXPECT_TRUE(is_taken(take_claim(file_)));
}

TEST_F(ClaimTest, OfAnotherMachineCountsWhileItGivesSignsOfLife) {
  leave_claim_of_dead_child();
  move_to_another_machine(Claim::dead_after / 2);
  const auto answer = take_claim(file_);
  ASSERT_FALSE(is_taken(answer));
  EXPECT_FALSE(std::get<ClaimHolder>(answer).is_near);
  EXPECT_THAT(std::get<ClaimHolder>(answer).host, testing::StartsWith("other-"));
  move_to_another_machine(Claim::dead_after + std::chrono::seconds(2));
  EXPECT_TRUE(is_taken(take_claim(file_)));
}

TEST_F(ClaimTest, IsClearedAwayWhereItsHolderIsKnownToBeDead) {
  remove_dead_claim(file_);  // there is none
  leave_claim_of_dead_child();
  remove_dead_claim(file_);
  EXPECT_TRUE(names_left().empty());
  leave_claim_of_dead_child();
  move_to_another_machine(std::chrono::hours(1));
  remove_dead_claim(file_);
  EXPECT_TRUE(fs::exists(file_));
  fs::remove(file_);
  const auto claim = take_claim(file_);
  remove_dead_claim(file_);
  EXPECT_TRUE(std::get<Claim>(claim).renew());
}

TEST_F(ClaimTest, ThatSaysNothingCountsByItsAge) {
  std::ofstream(file_) << "\xff garbage";
  EXPECT_FALSE(is_taken(take_claim(file_)));
  fs::last_write_time(file_, fs::file_time_type::clock::now() - Claim::dead_after - std::chrono::seconds(2));
  EXPECT_TRUE(is_taken(take_claim(file_)));
}

TEST_F(ClaimTest, KnowsThatItWasLost) {
  auto claim = take_claim(file_);
  fs::remove(file_);
  EXPECT_FALSE(std::get<Claim>(claim).renew());
  const auto other = take_claim(file_);
  ASSERT_TRUE(is_taken(other));
  EXPECT_FALSE(std::get<Claim>(claim).renew());
  claim = ClaimHolder();  // lets go of what is not its own
  EXPECT_TRUE(std::get<Claim>(other).renew());
}

TEST_F(ClaimTest, SignsOfLifeMakeItYoung) {
  const auto claim = take_claim(file_);
  fs::last_write_time(file_, fs::file_time_type::clock::now() - std::chrono::hours(1));
  ASSERT_TRUE(std::get<Claim>(claim).renew());
  EXPECT_LT(fs::file_time_type::clock::now() - fs::last_write_time(file_), std::chrono::minutes(1));
}

// All of them find the same dead claim, and live until all have asked.
TEST_F(ClaimTest, GoesToOneOfManyThatTakeItOverAtOnce) {
  constexpr int many = 8;
  for (int round = 0; round < 20; ++round) {
    leave_claim_of_dead_child();
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    std::vector<pid_t> children;
    for (int k = 0; k < many; ++k) {
      const pid_t child = fork();
      if (child == 0) {
        const auto claim = take_claim(file_);
        const char answer = is_taken(claim) ? 1 : 0;
        if (write(ends[1], &answer, 1) == 1) pause();
        _exit(0);
      }
      children.push_back(child);
    }
    int taken = 0;
    char answer = 0;
    for (int k = 0; k < many && read(ends[0], &answer, 1) == 1; ++k) taken += answer;
    for (const pid_t child : children) kill(child, SIGKILL), waitpid(child, nullptr, 0);
    close(ends[0]), close(ends[1]);
    ASSERT_EQ(taken, 1) << "in round " << round;
    fs::remove(file_);
  }
}

TEST_F(ClaimTest, SaysWhatStandsInItsPlace) {
  fs::create_directory(file_);
  EXPECT_THAT([&] { take_claim(file_); },
              testing::ThrowsMessage<InputError>(HasSubstr("this is a folder, not a file")));
  fs::remove(file_);
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT([&] { take_claim(file_); }, testing::ThrowsMessage<InputError>(HasSubstr("remove it")));
  EXPECT_THROW(take_claim(folder_.path() / "nowhere" / "claim"), OutputError);
}

}  // namespace
}  // namespace billow
