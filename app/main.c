/* Starts partc with options of the garbage collector that suit the command.

   A compile is short: old data is not collected before there is much of it, nor again before it is
   four times as much. The language server and the preview live long: they keep little memory, and have two cores, so
   that their answers do not wait for an analysis. In both, one thread collects garbage, and statistics are
   kept. The user's guide of GHC describes hs_main and RtsConfig ("Using your own main()"). */
#include <fcntl.h>
#include <string.h>
#include "Rts.h"

extern StgClosure ZCMain_main_closure;

/* Keeps the run-time system from taking the number of a closed standard stream for a file of its own.
   Reading or writing the stream still fails as on a closed one. */
static void occupyClosedStreams(void)
{
    for (int stream = 0; stream <= 2; stream++)
        if (fcntl(stream, F_GETFD) == -1)
            (void)open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
}

int main(int argc, char *argv[])
{
    occupyClosedStreams();
    RtsConfig config = defaultRtsConfig;
    int isServer = 0;
    for (int i = 1; i < argc; i++)
        isServer |= strcmp(argv[i], "lsp") == 0 || strcmp(argv[i], "preview") == 0;
    config.rts_opts = isServer ? "-O8m -F2 -N2 -qg -T" : "-O256m -F4 -qg -T";
    config.rts_opts_enabled = RtsOptsIgnoreAll;
    return hs_main(argc, argv, &ZCMain_main_closure, config);
}
