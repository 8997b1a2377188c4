; run --set X.kvv=3: exit 2
; error K-0073 at --set 1:3
X1 F1000
M30
