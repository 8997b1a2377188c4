; check: exit 1
; error 22003 at 4:1
; warning K-0003 at 4:1
#RT CYCLE DEF [SCOPE = PROG]
M30
