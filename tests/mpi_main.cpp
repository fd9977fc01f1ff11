// main() of tests that run on several ranks: rank 0 prints as usual, the others print failures
// only, and every rank returns the failure of any.

#include <gtest/gtest.h>
#include <mpi.h>

#include <iostream>

namespace {

class FailuresOfRank : public testing::EmptyTestEventListener {
 public:
  explicit FailuresOfRank(int rank) : rank_(rank) {}

  void OnTestPartResult(const testing::TestPartResult &result) override
  {
    if (result.failed())
      std::cerr << "rank " << rank_ << ": "
                << (result.file_name() ? result.file_name() : "unknown file") << ':'
                << result.line_number() << ": " << result.message() << std::endl;
  }

 private:
  int rank_;
};

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);

  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) {
    auto &listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOfRank(rank));
  }

  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
