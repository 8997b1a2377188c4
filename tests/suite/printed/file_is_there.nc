; run: exit 0
; page 207524491 existence of a file (#FILE EXIST)
; note K-0081 at 9:1
; note K-0109 at 5:18
N010 #FILE EXIST[PATH = "C:\TestDir\test.nc"]
N030 $IF V.G.FILE_EXIST == TRUE
N040 #MSG ["FILE EXISTS"]
N050 $ELSE
N060 #MSG ["FILE DOES NOT EXIST"]
N070 $ENDIF
N090 M30
