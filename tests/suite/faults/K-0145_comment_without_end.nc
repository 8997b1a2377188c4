; check: exit 1
; error K-0145 at 7:1
; error K-0145 at 9:5
; M30 is hidden as well; K-0003 does not say so again
F600
G01 X1
#COMMENT END
X2
N10 #COMMENT BEGIN
X9
M30
