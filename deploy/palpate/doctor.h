#pragma once
// What `palpate doctor` looks at. Each check answers in one line: what is there, or what is lacking and how to mend it.

#include <string>
#include <vector>

namespace palpate::deploy {

struct Finding {
  enum class State {
    ok,
    lacks,  // palpate works without, less well
    fails,  // palpate does not work until it is mended
  };
  std::string name;
  State state = State::ok;
  std::string text;
};

// doctor_machine.cpp
Finding check_processor();
Finding check_real_time();  // may a thread be SCHED_FIFO?
Finding check_memory_lock();
Finding check_timer();  // a tenth of a second at 1 kHz

// doctor_wire.cpp
Finding check_wire();           // a message through DDS, on sockets that hear this machine only
Finding check_shared_memory();  // is RouDi running?

// doctor_files.cpp
Finding check_nodes();
Finding check_plotter();
Finding check_gl();

// doctor_drivers.cpp
std::vector<Finding> check_drivers();  // one for each driver, from its own mouth

/// All of them, in the order in which a person should mend what is broken.
std::vector<Finding> check_all();

}  // namespace palpate::deploy
