// Runs that are killed at random moments: whatever they leave behind can be continued, and ends where an undisturbed run
// ends.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/apps/restarts.hpp"

namespace hemoflux::apps {
namespace {

class Kill : public Restart {
  protected:
    [[nodiscard]] bool has_checkpoint() const {
        if (!fs::exists(folder_ / "out")) return false;
        for (const auto& entry : fs::directory_iterator(folder_ / "out"))
            if (entry.path().extension() == ".bin") return true;
        return false;
    }

    /// Every checkpoint file must be whole; returns the step of the newest.
    [[nodiscard]] double newest_step() const {
        if (!has_checkpoint()) return -1;
        for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
            if (entry.path().extension() != ".bin") continue;
            EXPECT_NO_THROW(static_cast<void>(output::read_checkpoint(entry.path()))) << entry.path();
        }
        return last("out").checkpoint.number("step");
    }

    /// Kills the run `kills` times, each time a random while after it was started or continued.
    void survive(int kills, unsigned seed) const {
        const std::string anew = small_run + "--set output.checkpoint_interval_strain=0.004 ";
        const auto begin = std::chrono::steady_clock::now();
        ASSERT_EQ(run(anew + "-o whole").code, 0);
        const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> share(0, 1);
        double step = -1;
        for (int killed = 0; killed < kills;) {
            const pid_t pid =
                start(has_checkpoint() ? "run --quiet --restart out" : anew + "-o out", "printed.txt");
            std::this_thread::sleep_for(share(random) * whole);
            ::kill(pid, SIGKILL);
            int status = 0;
            ASSERT_EQ(::waitpid(pid, &status, 0), pid);
            if (WIFEXITED(status)) {  // it was done before
                ASSERT_EQ(WEXITSTATUS(status), 0) << content("printed.txt");
                expect_same_end("whole", "out");
                fs::remove_all(folder_ / "out");
                step = -1;
                continue;
            }
            ++killed;
            const double now = newest_step();
            EXPECT_GE(now, step) << "kill " << killed;
            step = now;
        }
        const Outcome rest = run(has_checkpoint() ? "run --quiet --restart out" : anew + "-o out");
        ASSERT_EQ(rest.code, 0) << rest.text;
        expect_same_end("whole", "out");
        for (const auto& entry : fs::directory_iterator(folder_ / "out"))
            EXPECT_FALSE(entry.path().extension() == ".bin" &&
                         entry.path().filename().string().starts_with('.'))
                << entry.path();
    }
};
class ValidationKill : public Kill {};

TEST_F(Kill, LeavesWhatCanBeContinued) { survive(4, 1); }

TEST_F(ValidationKill, AtFiftyRandomMoments) { survive(50, 2); }

}  // namespace
}  // namespace hemoflux::apps
