; check: exit 1
; page 251233163 diagnosis 20239, wrong
; error 20239 at 5:9
N10 G00 X0 Y0 Z0 P1=0
N20 $DO P1=P1+1
N50 $ENDDO P1<2
N1000 M30
