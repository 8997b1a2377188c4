; check: exit 0
; warning K-0100 at 3:1
G08
M30
