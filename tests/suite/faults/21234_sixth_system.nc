; check: exit 1
; error 21234 at 8:1
#CS DEF [1][1]
#CS DEF [2][2]
#CS DEF [3][3]
#CS DEF [4][4]
#CS DEF [5][5]
#CS DEF [6][6]
M30
