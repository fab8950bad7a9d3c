// render_main.c - hcsg-render: options, then one call.
#include "command/command.h"
#include "command/info.h"

#include <fcntl.h>
#include <signal.h>

// A standard stream that is closed would lend its number to the next file opened. This stands in
// for it, opened the wrong way round so that using it fails.
static void hold_standard_streams(void)
{
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) == -1)
            (void)!open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

static int tell_info(const struct given *given)
{
    struct error err;
    enum device_wish device;
    if (!device_wish_parse(&device, given->device, &err))
        return command_fail(&err, EXIT_INPUT);
    return info_print(device, &err) ? EXIT_FINE : command_fail(&err, EXIT_OUTPUT);
}

int main(int argc, char **argv)
{
    struct error err;
    struct given given;
    struct request request;
    hold_standard_streams();
    signal(SIGPIPE, SIG_IGN); // as errors of write, which are told and cleaned up
    signal(SIGXFSZ, SIG_IGN);
    switch (given_parse(&given, argc, argv, &err)) {
    case OPTIONS_DONE:
        return EXIT_FINE;
    case OPTIONS_WRONG:
        return command_fail(&err, EXIT_INPUT);
    case OPTIONS_UNTOLD:
        return command_fail(&err, EXIT_OUTPUT);
    case OPTIONS_RUN:
        break;
    }
    if (given.info)
        return tell_info(&given);
    return request_make(&request, &given, &err) ? command_run(&request)
                                                : command_fail(&err, EXIT_INPUT);
}
