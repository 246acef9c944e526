/* Printing that does nothing, to be loaded before the C library: what is left of an interpreter's time is not spent on text. */
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

int __printf_chk(int flag, const char *format, ...) { (void)flag, (void)format; return 0; }
int __fprintf_chk(FILE *file, int flag, const char *format, ...) { (void)file, (void)flag, (void)format; return 0; }
int __vfprintf_chk(FILE *file, int flag, const char *format, va_list values) { (void)file, (void)flag, (void)format, (void)values; return 0; }
int __vprintf_chk(int flag, const char *format, va_list values) { (void)flag, (void)format, (void)values; return 0; }
int printf(const char *format, ...) { (void)format; return 0; }
int fprintf(FILE *file, const char *format, ...) { (void)file, (void)format; return 0; }
int puts(const char *text) { (void)text; return 0; }
int fputs(const char *text, FILE *file) { (void)text, (void)file; return 0; }
int putchar(int character) { return character; }
int putc(int character, FILE *file) { (void)file; return character; }
int fputc(int character, FILE *file) { (void)file; return character; }
size_t fwrite(const void *data, size_t size, size_t count, FILE *file) { (void)data, (void)size, (void)file; return count; }
