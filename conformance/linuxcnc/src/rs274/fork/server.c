/* Loaded into a controller when it starts; once it has started, has it serve forks of itself.
 *
 * The fork point is where the controller first writes to its standard error. There its libraries are bound, its Python
 * is up and its tool table is read, and of a case nothing else is open. A fork takes the folder, the streams and the
 * process group of its case, and goes on as the controller would.
 *
 * The server's standard input is the control socket. It says that it is ready; then, for each request, which is a folder
 * and three streams, it tells that a fork has begun and how it ended. A byte lets go of the fork, before its end or after
 * it: what is left of its group is ended. At the end of the control socket, everything ends.
 */

#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

/* What is told, with a number: nothing, a process, a status as wait(2) has it. */
enum { READY = 'R', BEGUN = 'B', ENDED = 'E' };

/* Above each descriptor that the controller takes by itself. */
enum { LOWEST_CONTROL = 200 };

/* The control socket; none outside the server. */
static int control = -1;

/* The file that the controller writes through memory; a fork needs one of its own. */
static struct {
    void *address;
    size_t length;
    int protection, descriptor;
    char name[NAME_MAX + 1];
} shared = {.descriptor = -1};

/* Whether something is shared that a fork cannot have of its own. */
static bool unfit;

/* What was open before the controller opened anything: each start of it has that. */
static fd_set inherited;

static bool tell(int32_t kind, int32_t number) {
    int32_t message[] = {kind, number};
    return send(control, message, sizeof message, MSG_NOSIGNAL) == sizeof message;
}

/* Lists what is open. */
static bool list_open(fd_set *all) {
    FD_ZERO(all);
    DIR *descriptors = opendir("/proc/self/fd");
    if (!descriptors) return false;
    bool fits = true;
    for (struct dirent *entry; (entry = readdir(descriptors));) {
        int descriptor = entry->d_name[0] == '.' ? dirfd(descriptors) : atoi(entry->d_name);
        if (descriptor >= FD_SETSIZE) fits = false;
        else if (descriptor != dirfd(descriptors)) FD_SET(descriptor, all);
    }
    closedir(descriptors);
    return fits;
}

/* Takes the control socket from standard input, where a controller finds a pipe. */
__attribute__((constructor)) static void begin(void) {
    int ends[2];
    unsetenv("LD_PRELOAD");
    unsetenv("LD_BIND_NOW");
    control = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, LOWEST_CONTROL);
    if (control < 0 || pipe(ends) != 0 || dup2(ends[0], STDIN_FILENO) < 0) _exit(EXIT_FAILURE);
    close(ends[0]);
    close(ends[1]);
    unfit = !list_open(&inherited);
}

/* Remembers what is behind a shared mapping: one whole file in the controller's folder, or a fork cannot have its own. */
static void remember(void *address, size_t length, int protection, int descriptor, off_t offset) {
    char link[64], path[PATH_MAX] = "";
    struct stat mapped, named;
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const char *slash = readlink(link, path, sizeof path - 1) > 0 ? strrchr(path, '/') : NULL;
    const char *name = slash ? slash + 1 : "";
    bool found = fstat(descriptor, &mapped) == 0 && stat(name, &named) == 0;
    bool here = found && mapped.st_dev == named.st_dev && mapped.st_ino == named.st_ino;
    if (shared.address || !here || offset != 0 || strlen(name) > NAME_MAX) {
        unfit = true;
        return;
    }
    shared.address = address;
    shared.length = length;
    shared.protection = protection;
    shared.descriptor = descriptor;
    strcpy(shared.name, name);
}

void *mmap(void *at, size_t length, int protection, int flags, int descriptor, off_t offset) {
    void *mapped = (void *)syscall(SYS_mmap, at, length, protection, flags, descriptor, offset);
    bool is_shared = mapped != MAP_FAILED && (flags & MAP_TYPE) != MAP_PRIVATE;
    if (control >= 0 && is_shared) remember(mapped, length, protection, descriptor, offset);
    return mapped;
}

void *mmap64(void *at, size_t length, int protection, int flags, int descriptor, off64_t offset) {
    return mmap(at, length, protection, flags, descriptor, offset);
}

int munmap(void *at, size_t length) {
    if (at == shared.address) unfit = true;
    return (int)syscall(SYS_munmap, at, length);
}

static int open_process(pid_t process) {
    return (int)syscall(SYS_pidfd_open, process, 0);
}

/* Whether forks will be as the controller: it has one thread, and opened nothing but what a fork gets anew. */
static bool is_fit(void) {
    struct stat threads;
    fd_set now;
    if (unfit || stat("/proc/self/task", &threads) != 0 || !list_open(&now)) return false;
    for (int descriptor = 0; descriptor < FD_SETSIZE; descriptor++) {
        bool known = FD_ISSET(descriptor, &inherited) || descriptor == shared.descriptor;
        if (FD_ISSET(descriptor, &now) && !known) return false;
    }
    int self = open_process(getpid());
    return threads.st_nlink == 3 && self >= 0 && close(self) == 0;
}

/* Puts a file in this folder, with the same bytes, where the server's is mapped and open. */
static bool own_shared(void) {
    struct stat whole;
    if (!shared.address) return true;
    int file = open(shared.name, O_RDWR | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || fstat(shared.descriptor, &whole) != 0) return false;
    off_t place = lseek(shared.descriptor, 0, SEEK_CUR);
    size_t length = shared.length < (size_t)whole.st_size ? shared.length : (size_t)whole.st_size;
    bool written = ftruncate(file, whole.st_size) == 0 &&
                   pwrite(file, shared.address, length, 0) == (ssize_t)length &&
                   lseek(file, place, SEEK_SET) == place &&
                   dup2(file, shared.descriptor) == shared.descriptor && close(file) == 0;
    return written && mmap(shared.address, shared.length, shared.protection, MAP_SHARED | MAP_FIXED,
                           shared.descriptor, 0) == shared.address;
}

/* Takes a request; none at the end of the control socket. */
static bool take(char folder[PATH_MAX], int streams[3]) {
    union {
        char bytes[CMSG_SPACE(3 * sizeof(int))];
        struct cmsghdr aligned;
    } space;
    struct iovec text = {.iov_base = folder, .iov_len = PATH_MAX - 1};
    struct msghdr message = {.msg_iov = &text,
                             .msg_iovlen = 1,
                             .msg_control = space.bytes,
                             .msg_controllen = sizeof space.bytes};
    ssize_t length = recvmsg(control, &message, MSG_CMSG_CLOEXEC);
    struct cmsghdr *passed = length > 0 ? CMSG_FIRSTHDR(&message) : NULL;
    if (!passed || passed->cmsg_len != CMSG_LEN(3 * sizeof(int))) return false;
    memcpy(streams, CMSG_DATA(passed), 3 * sizeof(int));
    folder[length] = '\0';
    return true;
}

/* Gives a fork what is its own. It ends with the server. */
static void become(const char *folder, const int streams[3], pid_t server) {
    bool done = prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() == server &&
                setpgid(0, 0) == 0 && chdir(folder) == 0 && setenv("HOME", folder, 1) == 0;
    for (int stream = 0; stream < 3; stream++) {
        done = done && dup2(streams[stream], stream) == stream && close(streams[stream]) == 0;
    }
    if (!done || !own_shared() || !tell(BEGUN, getpid())) _exit(EXIT_FAILURE);
    close(control);
    control = -1;
}

/* Waits for the end of a fork, or until it is let go; then ends what is left of it. */
static void attend(pid_t forked) {
    char byte;
    siginfo_t end = {0};
    setpgid(forked, forked);
    struct pollfd events[] = {{.fd = open_process(forked), .events = POLLIN},
                              {.fd = control, .events = POLLIN}};
    /* A fork ends with its server. */
    if (events[0].fd < 0) _exit(EXIT_FAILURE);
    while (poll(events, 2, -1) < 0 && errno == EINTR) {}
    if (events[1].revents) kill(-forked, SIGKILL);
    waitid(P_PID, forked, &end, WEXITED | WNOWAIT);
    tell(ENDED, end.si_code == CLD_EXITED ? end.si_status << 8 : end.si_status);
    bool listens = read(control, &byte, 1) == 1;
    /* Until it is waited for, its number is its own and its group's. */
    kill(-forked, SIGKILL);
    waitpid(forked, NULL, 0);
    close(events[0].fd);
    if (!listens) _exit(EXIT_SUCCESS);
}

/* Serves until the control socket ends. Only forks return. */
static void serve(void) {
    char folder[PATH_MAX];
    int streams[3];
    pid_t server = getpid();
    if (!is_fit() || !tell(READY, 0)) _exit(EXIT_FAILURE);
    while (take(folder, streams)) {
        pid_t forked = fork();
        if (forked < 0) break;
        if (forked == 0) {
            become(folder, streams, server);
            return;
        }
        for (int stream = 0; stream < 3; stream++) close(streams[stream]);
        attend(forked);
    }
    _exit(EXIT_SUCCESS);
}

size_t fwrite(const void *data, size_t size, size_t count, FILE *stream) {
    static size_t (*write_on)(const void *, size_t, size_t, FILE *);
    if (control >= 0 && stream == stderr) serve();
    if (!write_on) *(void **)&write_on = dlsym(RTLD_NEXT, "fwrite");
    return write_on(data, size, count, stream);
}
