; check: exit 0
; warning 21316 at 4:1
G238
G05
M30
