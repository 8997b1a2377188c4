; check: exit 1
; error K-0019 at 4:1
; error 22129 at 9:1
#RT WHILE
G01 F500
G151
X1
X2
#RT ENDWHILE
M30
