; check: exit 1
; error 20491 at 3:27
#JOG CONT [AX=X FEED1=1.0 FEED2=-1.5 FEED3=2.0]
M30
