; check --set channel.spdl_anzahl=0: exit 1
; warning K-0074 at xyz/channel.lis 12:1
; note K-0075 at -
; error 21548 at 5:1
M3
M30
