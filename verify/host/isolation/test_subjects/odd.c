/* SPDX-License-Identifier: MIT */
/* Libraries that are none: what each gets wrong is chosen when it is compiled. */
#include <limitcheck/subject.h>
#include <stdlib.h>

#if defined(CRASHES_WHEN_LOADED)
__attribute__((constructor)) static void crash(void) {
  abort();
}
#endif

#if defined(NEEDS_ANOTHER_LIBRARY)
int function_of_another_library(void);
int call_it(void);
int call_it(void) {
  return function_of_another_library();
}
#endif

#if !defined(NO_ENTRY)
const lc_subject* lc_subject_get(uint32_t abi) {
  static lc_subject subject;
  (void)abi;
#if defined(SERVES_NOTHING)
  return NULL;
#endif
#if defined(OTHER_INTERFACE)
  subject.abi = LC_SUBJECT_ABI + 41;
#else
  subject.abi = LC_SUBJECT_ABI;
#endif
  return &subject;
}
#else
extern int unused;
#endif
