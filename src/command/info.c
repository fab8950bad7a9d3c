// info.c - what hcsg is made of, and what draws on this machine.
#include "command/info.h"

#include "base/parallel.h"
#include "render/gl/context.h"
#include "render/scheme_choose.h"

#include <stdlib.h>
#include <sys/utsname.h>

static void print_system(void)
{
    struct utsname u;
    if (uname(&u) == 0)
        printf("System: %s %s %s\n", u.sysname, u.release, u.machine);
    printf("Compiler: %s\n", __VERSION__);
    printf("Libraries: %s\n", HCSG_LIBRARIES);
}

static void print_context(void)
{
    struct error why;
    struct gl_context *context = gl_context_new(NULL, &why);
    if (!context) {
        printf("Device gl: %s\n", why.text);
        return;
    }
    const struct gl_facts *f = gl_context_facts(context);
    printf("Device gl: %s, %s%s\n", f->renderer, f->version, f->software ? ", in software" : "");
    if (!gl_facts_suffice(f, &why))
        printf("Device gl: %s\n", why.text);
    gl_context_delete(context);
}

static void print_devices(enum device_wish wish)
{
    struct error why;
    printf("Device cpu: %u threads\n", parallel_workers(0));
    print_context();
    struct device *device = device_choose(wish, NULL, &why);
    printf("Draws with: %s\n", why.text);
    device_delete(device);
}

static void print_variable(const char *name)
{
    const char *value = getenv(name);
    printf("%s: %s\n", name, value && *value ? value : "not set");
}

bool info_print(enum device_wish device, struct error *err)
{
    printf("hcsg %s\n", HCSG_VERSION);
    print_system();
    print_devices(device);
    scheme_print_folders(stdout);
    print_variable("OPENSCAD");
    print_variable("OPENSCAD_FONT_PATH");
    print_variable("TMPDIR");
    if (fflush(stdout) == 0 && !ferror(stdout))
        return true;
    error_set(err, "standard output: cannot write");
    return false;
}
