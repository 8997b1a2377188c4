; check: exit 1
; error 21891 at 3:22
G01 X10 F1000 #RND=1 #RND=2
Y10
M30
