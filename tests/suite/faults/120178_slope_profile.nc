; check: exit 1
; error 120178 at 3:19
#SET SLOPE PROFIL[9]
M30
