/* An adapter for Gaugeblock, protocol 1: connect your controller in `run`. `gaugeblock adapter protocol` has the rest.
   cc -std=c99 -Wall -o adapter adapter.c; a real adapter takes a JSON library */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static const char *declaration =
    "{\"protocol\":1,\"name\":\"toy in C\",\"version\":\"0.1\",\"languages\":[\"rs274\"],\"units\":[\"mm\",\"inch\"],\"features\":[],"
    "\"observables\":{\"fields\":[\"position\"],\"fields_at_effects\":[],\"effects\":[\"straight_traverse\"],\"moves_in_place\":true,"
    "\"fault_kinds\":false,\"final_parameters\":false,\"pins\":[]},\"resolution\":0,\"clock\":\"virtual\","
    "\"language\":{\"g\":[\"0\",\"21\"],\"m\":[\"2\"],\"axes\":\"XYZ\",\"letters\":\"\",\"parameters\":[],"
    "\"expressions\":false,\"o_words\":false,\"comments\":[]}}";

/* What the controller did with a program, whose lines end with the two characters \n as JSON writes them. This one knows G0, G21, M2. */
static void run(const char *text, const char *end)
{
    double at[3] = {0, 0, 0};
    int line = 1, traverse = 0, over = 0;
    printf("\"outcome\":{\"language\":\"rs274\",\"start\":{},\"steps\":[");
    for (; text < end && !over; text += 2, line++) {
        const char *block = text;
        for (; text < end && strncmp(text, "\\n", 2) != 0; text++) {
            char *after, letter = *text, *place = strchr("xyz", letter);
            double number = letter == ' ' ? 0 : strtod(text + 1, &after);
            if (letter == ' ') continue;
            if ((letter != 'g' || (number != 0 && number != 21)) && (letter != 'm' || number != 2) && (place == NULL || !traverse)) {
                printf("],\"end\":{\"end\":\"fault\",\"block\":{\"file\":\"main.ngc\",\"line\":%d},\"message\":\"unknown word\"}}", line);
                return;
            }
            if (place != NULL)
                at[strlen("xyz") - strlen(place)] = number;
            traverse |= letter == 'g' && number == 0;
            over |= letter == 'm';
            text = after - 1;
        }
        printf("%s{\"block\":{\"file\":\"main.ngc\",\"line\":%d},\"events\":[", line > 1 ? "," : "", line);
        if (strcspn(block, "xyz") < (size_t)(text - block))
            printf("{\"do\":{\"effect\":\"straight_traverse\",\"end\":{\"x\":%.17g,\"y\":%.17g,\"z\":%.17g}}}", at[0], at[1], at[2]);
        printf("],\"state\":{\"language\":\"rs274\",\"position\":{\"x\":%.17g,\"y\":%.17g,\"z\":%.17g}}}", at[0], at[1], at[2]);
    }
    printf("],\"end\":{\"end\":\"%s\"}}", over ? "program_end" : "percent_end");
}

int main(void)
{
    char *line = NULL;
    for (size_t over = 0, room = 0; !over && getline(&line, &room, stdin) > 0; fflush(stdout)) {
        const char *found = strstr(line, "\"main\":\""), *from = found ? found + 8 : "", *to = from;
        while (*to != '"' && *to != 0)
            to += *to == '\\' ? 2 : 1;
        printf("{\"id\":%ld,%s", strtol(strstr(line, "\"id\":") + 5, NULL, 10), strstr(line, "\"op\":\"hello\"") ? "\"hello\":" : "");
        over = strstr(line, "\"op\":\"bye\"") != NULL;
        if (strstr(line, "\"op\":\"run\"") != NULL)
            run(from, to);
        else
            printf("%s", strstr(line, "\"op\":\"hello\"") ? declaration : over || strstr(line, "\"op\":\"reset\"") ? "\"done\":{}" : "\"refused\":\"?\"");
        printf("}\n");
    }
    return 0;
}
