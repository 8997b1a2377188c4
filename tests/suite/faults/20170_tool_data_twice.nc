; check: exit 1
; error 20170 at 4:4
; warning K-0114 at 4:4
D1 D2
M30
