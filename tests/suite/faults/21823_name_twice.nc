; check: exit 1
; error 21823 at 3:25
#FILE NAME [MSG="a.txt" MSG="b.txt"]
M30
