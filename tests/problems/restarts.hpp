// A run that stops after `steps`, is written, read and goes on has the bits of one that never stopped.
#pragma once

#include "problems/build_scene.hpp"
#include "problems/run_checkpoint.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/observers.hpp"

#include <gtest/gtest.h>
#include <initializer_list>

namespace ballast {

/// state_of(scene): all that must be the same. The part before the stop runs on one thread, the rest on two.
template <int Dim, class State> void expect_restarts(const SceneSpec& spec, std::initializer_list<long> steps, State&& state_of) {
  Scene<Dim> whole = build_scene<Dim>(spec, 1);
  Clock clock;
  clock.end_time = spec.end_time;
  run(whole, clock);

  const io::TemporaryFolder folder; // of its own: another build's tests may run beside
  const auto path = folder.path() / "checkpoint.h5";
  for (const long step : steps) {
    Scene<Dim> part = build_scene<Dim>(spec, 1), again = build_scene<Dim>(spec, 2);
    Clock half, go_on;
    half.end_time = go_on.end_time = spec.end_time;
    StepLimit<Dim> stop(step);
    ASSERT_FALSE(run(part, half, {&stop}));
    RunMemory memory;
    memory.deck_hash = "x";
    write_checkpoint(path, part, half, memory);
    read_checkpoint(path, again, go_on, memory);
    EXPECT_TRUE(state_of(again) == state_of(part)) << "at step " << step;
    StepLimit<Dim> enough(clock.step + 1); // a run that goes on wrongly may never end
    run(again, go_on, {&enough});
    EXPECT_EQ(go_on.step, clock.step);
    EXPECT_TRUE(state_of(again) == state_of(whole)) << "from step " << step;
  }
}

} // namespace ballast
