; check: exit 1
; error 20486 at 3:27
#JOG INCR [AX=X DIST1=0.1 FEED=-1.0]
M30
