; check: exit 1
; error 21220 at 3:16
#VIB GUARD ON [FOO=1]
M30
