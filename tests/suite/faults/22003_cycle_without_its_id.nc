; check: exit 1
; error 22003 at 3:1
#RT CYCLE DEF [SCOPE = PROG]
M30
