; check: exit 1
; error K-0009 at 3:19
#SET SLOPE PROFIL[9]
M30
