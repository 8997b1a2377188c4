; check: exit 1
; page 482566155 position of an axis set in the channel (SET_POSITION)
; error K-0019 at 8:7
N10 G01 F2000 X0 Y0 Z0
N20 $FOR P1=0,100,1
N30 G91 X1
N40 $ENDFOR
N50 X[SET_POSITION POS=100]
N60 M30
