; run: exit 0
; page 208400267: a macro may be redefined; a use inserts its present text, also in lines that were executed before
; end X8 Y3
%L STEP
N10 Y["LENGTH"]
N20 M17
%MAIN
N30 "LENGTH" = "1"
N40 G91 G01 F3000
N50 $FOR P1 = 1,3,1
N60 X["LENGTH"]
N70 "LENGTH" = "2"
N80 $ENDFOR
N90 "LENGTH" = "1"
N100 LL STEP
N110 "LENGTH" = "2"
N120 LL STEP
N130 "WHOLE" = "X1"
N140 $FOR P1 = 1,2,1
N150 "WHOLE"
N160 "WHOLE" = "X2"
N170 $ENDFOR
N180 M30
