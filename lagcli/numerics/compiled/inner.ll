define $real @inner(ptr %a, ptr %b, i64 %n) $how nounwind {
entry:
  %any = icmp sgt i64 %n, 0
  %zero = sitofp i64 0 to $real
  br i1 %any, label %loop, label %none
none:
  ret $real %zero
loop:
  %i = phi i64 [ 0, %entry ], [ %next, %loop ]
  %s = phi $real [ %zero, %entry ], [ %sum, %loop ]
  %pa = getelementptr $real, ptr %a, i64 %i
  %pb = getelementptr $real, ptr %b, i64 %i
  %x = load $real, ptr %pa
  %y = load $real, ptr %pb
  %xy = fmul $real %x, %y
  %sum = fadd $real %s, %xy
  %next = add i64 %i, 1
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  ret $real %sum
}