#include "scenarios/campaign/sweep_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "base/error.h"

namespace alula::scenarios::campaign {
namespace fs = std::filesystem;

SweepFolder::SweepFolder(const fs::path& folder, bool fresh) : folder_(folder) {
  std::error_code error;
  fs::create_directories(folder_, error);
  const fs::path file = folder_ / "sweep.lock";
  if (!error) lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) {
    const std::string why = error ? error.message() : std::system_category().message(errno);
    throw base::InputError("--out: cannot write to " + folder_.string() + " (" + why +
                           "); name a folder that can be written");
  }
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw base::InputError("--out: another sweep is at work in " + folder_.string() +
                           "; wait for it, or name another folder");
  }
  if (fresh) {
    for (const char* name : {"sweep.db", "sweep.db-journal", "runs", ".work", "shards", "slurm", "plan.json"}) {
      fs::remove_all(folder_ / name, error);
    }
  }
}

SweepFolder::~SweepFolder() { ::close(lock_); }

}  // namespace alula::scenarios::campaign
