; check: exit 1
; error 21599 at 4:10
#CS ADD [WCS][15,20,0,0,0,0]
#CS ADD [WCS][10,15,0,0,0,5]
M30
