; check: exit 1
; error K-0145 at 7:1
; error K-0145 at 9:5
; warning K-0003 at 8:1
F600
G01 X1
#COMMENT END
X2
N10 #COMMENT BEGIN
X9
M30
