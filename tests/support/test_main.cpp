// The main function of every test program. It outlives the program's threads, or a leak checker that looks at
// the program's end may meet a thread that is half gone, and fail.
#include <gtest/gtest.h>

#include "base/parallel.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const tyndall::ThreadsLife threads;
  return RUN_ALL_TESTS();
}
