
declare <4 x double> @llvm.fmuladd.v4f64(<4 x double>, <4 x double>, <4 x double>)
declare double @llvm.vector.reduce.fadd.v4f64(double, <4 x double>)
define double @inner(ptr %a, ptr %b, i64 %n) $how nounwind {
entry:
  %any = icmp sgt i64 %n, 0
  br i1 %any, label %loop, label %none
none:
  ret double 0.0
loop:
  %i = phi i64 [ 0, %entry ], [ %next, %loop ]
  %s = phi <4 x double> [ zeroinitializer, %entry ], [ %sum, %loop ]
  %pa = getelementptr double, ptr %a, i64 %i
  %pb = getelementptr double, ptr %b, i64 %i
  %x = load <4 x double>, ptr %pa, align 8
  %y = load <4 x double>, ptr %pb, align 8
  %sum = call <4 x double> @llvm.fmuladd.v4f64(<4 x double> %x, <4 x double> %y, <4 x double> %s)
  %next = add i64 %i, 4
  %more = icmp slt i64 %next, %n
  br i1 %more, label %loop, label %end
end:
  %r = call reassoc double @llvm.vector.reduce.fadd.v4f64(double -0.0, <4 x double> %sum)
  ret double %r
}