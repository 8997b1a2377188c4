; A rectangular pocket in passes of growing width, computed with P parameters and a loop.
; P1 length, P2 width, P3 step over, P4 corner radius.
%PARAMETRIC_POCKET
N10 G71 G90 G17 G53
N20 #SLOPE [TYPE=TRAPEZ]
N30 P1=40 P2=24 P3=4 P4=2
N40 P10=INT[[P2/2-P4]/P3]          ; passes
N50 G00 X0 Y0 Z2
N60 G01 Z-1 F600
N70 $FOR P20=1, P10, 1
N80   P21=P20*P3                   ; half width of this pass
N90   P22=P21+[P1-P2]/2            ; half length
N100  G01 X[-P22] Y[-P21+P4] F3000
N110  G03 X[-P22+P4] Y[-P21] I[P4] J0
N120  G01 X[P22-P4]
N130  G03 X[P22] Y[-P21+P4] I0 J[P4]
N140  G01 Y[P21-P4]
N150  G03 X[P22-P4] Y[P21] I[-P4] J0
N160  G01 X[-P22+P4]
N170  G03 X[-P22] Y[P21-P4] I0 J[-P4]
N180  G01 Y[-P21+P4]
N190  #MSG ["pass %d of %d, half width %f mm", P20, P10, P21]
N200 $ENDFOR
N210 G00 Z5
N220 M30
