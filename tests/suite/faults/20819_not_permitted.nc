; check --set channel.prog_start.g_gruppe[3].nr=60: exit 0
; warning 20819 at -
M30
