/* The same as circle.cpp, in C99: goals in (t,x,y,z), what is felt of a flat depth image out. */
#include <stdio.h>
#include <string.h>

#include <dibhr/dibhr.h>

static unsigned char levels[486][720];

static void print_vector(const double v[3]) {
    printf("%.17g,%.17g,%.17g,", v[0], v[1], v[2]);
}

int main(void) {
    const dibhr_image image = {levels, DIBHR_LEVELS_8_BIT, 720, 486, 0, 0.0};
    double t, x, y, z, last_t = -0.001;
    dibhr_touch touch;
    dibhr_handle* hand = dibhr_create();
    memset(levels, 128, sizeof levels);
    if (dibhr_set_depth(hand, &image, NULL) != DIBHR_OK ||
        dibhr_set(hand, "static-friction", 0.4) != DIBHR_OK ||
        dibhr_set(hand, "dynamic-friction", 0.4) != DIBHR_OK) {
        fprintf(stderr, "%s\n", dibhr_last_error(hand));
        return 1;
    }
    for (; scanf("%lf,%lf,%lf,%lf", &t, &x, &y, &z) == 4; last_t = t) {
        dibhr_update(hand, x, y, z, t - last_t, &touch);
        printf("%.17g,", t);
        print_vector(touch.goal);
        print_vector(touch.proxy);
        print_vector(touch.spring_force);
        print_vector(touch.sent_force);
        printf("%d,%s,%d,%d,%d\n", touch.contact, dibhr_primitive_name(touch.primitive), touch.i,
               touch.j, touch.moves);
    }
    dibhr_destroy(hand);
    return 0;
}
