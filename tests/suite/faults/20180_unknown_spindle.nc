; check: exit 1
; error 20180 at 3:1
SPDL=1000
M30
