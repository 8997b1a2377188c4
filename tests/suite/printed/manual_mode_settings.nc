; run: exit 0
; page 206683659 settings of an axis in manual mode
; end X10 Y0
; warning K-0100 at 10:1
; warning K-0100 at 11:1
; warning K-0100 at 12:1
; warning K-0100 at 13:1
; warning K-0111 at 15:1
%main
#HANDWHEEL [AX=X RES1=0.1 RES2=0.2 RES3=0.5]
#JOG CONT [AX=X FEED1=1.0 FEED2=1.5 FEED3=2.0]
#JOG INCR [AX=X DIST1=0.1 FEED1=1.0 DIST2=0.2 FEED2=1.5 DIST3=0.5 FEED3=2.0]
#MANUAL LIMITS [AX=X NEGATIVE=-5 POSITIVE=5]
G01 X10 F1000
G201 X1
G202 X1
M30
