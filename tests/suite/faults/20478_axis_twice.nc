; run: exit 1
; error 20478 at 3:1
G201 #ACHSE[X,Y,X]
M30
