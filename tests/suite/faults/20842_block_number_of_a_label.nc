; check: exit 1
; error 20842 at 3:2
N99999999999 [PLACE] G00 X1
M30
