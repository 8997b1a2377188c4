; run: exit 0
; end X3 Y0
; note K-0109 at 9:14
(a file is searched where subroutines are, with either slash; what is not there is 0)
G91 G01 F1000
#FILE EXIST [PATH="called\unpassed.nc"]
X V.G.FILE_EXIST
#FILE EXIST [PATH="called/unpassed.nc"]
#FILE EXIST [PATH="called/no_such_file.nc"]
Y V.G.FILE_EXIST
#FILE EXIST [PATH="file_that_is_there.nc"]
$IF V.G.FILE_EXIST_PATH_NAME == "file_that_is_there.nc"
X2
$ENDIF
M30
