#include "Sandbox.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>

#ifdef __linux__
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cstddef>
#include <vector>
#endif

namespace suture {

namespace {

void limit(int what, rlim_t soft) {
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource>(what), &now) != 0) return;
  now.rlim_cur = std::min(soft, now.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(what), &now);
}

}  // namespace

void limitThisProcess(std::size_t bytes, double seconds) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  limit(RLIMIT_AS, bytes);
  limit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(seconds)) + 1);
  limit(RLIMIT_CORE, 0);
}

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))

bool forbidProgramsAndFiles() {
#ifdef __x86_64__
  constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#else
  constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#endif
  constexpr unsigned allow = SECCOMP_RET_ALLOW, no = SECCOMP_RET_ERRNO | EPERM, unknown = SECCOMP_RET_ERRNO | ENOSYS;
  std::vector<sock_filter> rules;
  const auto load = [&](std::size_t offset) { rules.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset))); };
  const auto answer = [&](unsigned value) { rules.push_back(BPF_STMT(BPF_RET | BPF_K, value)); };
  const auto number = [&] { load(offsetof(seccomp_data, nr)); };
  // Each rule expects the number of the system call to be loaded, and leaves it loaded.
  const auto refuse = [&](long call, unsigned with) {
    rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 1));
    answer(with);
  };
  const auto refuseUnless = [&](long call, int argument, unsigned mask, bool wanted) {
    rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 4));
    load(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(argument));  // the low half: little-endian machines only
    rules.push_back(sock_filter{BPF_JMP | BPF_JSET | BPF_K, static_cast<unsigned char>(wanted), static_cast<unsigned char>(!wanted), mask});
    answer(no);
    number();
  };

  load(offsetof(seccomp_data, arch));
  rules.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0));
  answer(no);
  number();
#ifdef __x86_64__
  rules.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000u, 0, 1));  // system calls of the x32 interface
  answer(no);
#endif
  constexpr unsigned writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC;
  refuseUnless(SYS_openat, 2, writing, false);
  refuseUnless(SYS_clone, 0, CLONE_THREAD, true);  // threads are allowed
  for (const long call :
       {SYS_execve,    SYS_execveat,          SYS_unlinkat, SYS_renameat2, SYS_mkdirat,  SYS_linkat,        SYS_symlinkat, SYS_truncate,
        SYS_ftruncate, SYS_mknodat,           SYS_fchmod,   SYS_fchmodat,  SYS_fchownat, SYS_fchown,        SYS_socket,    SYS_kill,
        SYS_ptrace,    SYS_process_vm_writev, SYS_mount,    SYS_chroot,    SYS_setxattr, SYS_io_uring_setup})
    refuse(call, no);
#ifdef SYS_open
  refuseUnless(SYS_open, 1, writing, false);
  for (const long call : {SYS_creat, SYS_unlink, SYS_rename, SYS_mkdir, SYS_rmdir, SYS_link, SYS_symlink, SYS_mknod, SYS_chmod, SYS_chown,
                          SYS_fork, SYS_vfork})
    refuse(call, no);
#endif
#ifdef SYS_renameat
  refuse(SYS_renameat, no);
#endif
#ifdef SYS_clone3
  refuse(SYS_clone3, unknown);  // its flags lie in memory; the C library falls back to clone
#endif
#ifdef SYS_openat2
  refuse(SYS_openat2, unknown);
#endif
  answer(allow);

  const sock_fprog program{static_cast<unsigned short>(rules.size()), rules.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

#else

bool forbidProgramsAndFiles() { return false; }

#endif

}  // namespace suture
