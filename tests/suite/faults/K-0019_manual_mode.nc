; check: exit 1
; error K-0019 at 3:1
#JOG CONT
M30
