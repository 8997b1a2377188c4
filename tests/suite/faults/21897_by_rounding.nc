; check: exit 1
; error 21897 at 11:5
; Five thousand steps end at the limit but for rounding, which is not outside; an increment beyond it is.
N10 G91 F60000
$FOR P1=1,5000,1
N20 G01 X0.1
$ENDFOR
N30 G01 X-1
N40 X1.00004
N50 X-1
N60 X1.0001
M30
