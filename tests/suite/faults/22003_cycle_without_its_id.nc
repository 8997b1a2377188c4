; check: exit 1
; error 22003 at 4:1
; everything after it belongs to the cycle, so K-0003 does not report a missing M30
#RT CYCLE DEF [SCOPE = PROG]
M30
