#pragma once
// ITK's parts (GDCM, MetaIO, niftilib, nrrdio) print to stderr by four different ways. The person gets one line, ours.

namespace palpate {

/// While it lives, what is written to stderr is dropped.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_;
};

}  // namespace palpate
