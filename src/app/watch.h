// watch.h - tells when files were saved, in whatever way an editor does it.
//
// Folders are watched, not files: a save that renames a new file over the old one, a file that is
// deleted and comes back, and one that does not exist yet are all seen. Once a second the files are
// looked at as well, for folders that send no events (network file systems) or come and go.
#pragma once
#include <stdint.h>

struct uv_loop_s;
struct watch;

// `saved` is called from the loop when no event came for a few milliseconds; `noticed` is the
// clock_seconds of the first event.
struct watch *watch_new(struct uv_loop_s *loop, void (*saved)(void *context, double noticed),
                        void *context);
// Watches these files and no others. Does nothing when they are the ones already watched. Files
// that are new among them and changed after `since` (clock_seconds) count as saved.
void watch_set(struct watch *w, char *const *paths, uint32_t count, double since);
// The watch is gone once the loop has run.
void watch_delete(struct watch *w);
