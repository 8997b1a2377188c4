; check --set channel.prog_start.g_gruppe[8].nr=77: exit 0
; warning 20819 at -
M30
