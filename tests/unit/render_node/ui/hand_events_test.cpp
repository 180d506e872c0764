#include "render_node/ui/hand_events.h"

#include <gtest/gtest.h>

namespace palpate::render {
namespace {

TEST(HandEvents, CountTapsBetweenTwoPictures) {
  HandEvents events;
  events.key('T', true);
  events.key('T', false);
  EXPECT_EQ(events.presses('T'), 1);
  EXPECT_TRUE(events.down('T'));
  EXPECT_DOUBLE_EQ(events.held('T', 0.3), HandEvents::tap_s);
  events.key('T', true);
  events.key('T', false);
  EXPECT_EQ(events.presses('T'), 2);
  events.forget();
  EXPECT_EQ(events.presses('T'), 0);
  EXPECT_FALSE(events.down('T'));
  EXPECT_EQ(events.held('T', 0.3), 0);
}

TEST(HandEvents, KnowWhatIsHeldOverManyPictures) {
  HandEvents events;
  events.key('A', true);
  events.forget();
  EXPECT_EQ(events.presses('A'), 0);
  EXPECT_TRUE(events.down('A'));
  EXPECT_DOUBLE_EQ(events.held('A', 0.3), 0.3);
  events.key('A', true);  // repeated by the keyboard
  EXPECT_EQ(events.presses('A'), 0);
  events.leave();
  EXPECT_FALSE(events.down('A'));
}

TEST(HandEvents, SumUpADragThatBeginsAndEndsBetweenTwoPictures) {
  HandEvents events;
  events.cursor(100, 50);
  events.button(0, true);
  events.cursor(130, 40);
  events.cursor(120, 45);
  events.button(0, false);
  events.cursor(500, 500);
  EXPECT_EQ(events.drag(0), Eigen::Vector2d(20, -5));
  EXPECT_EQ(events.drag(1), Eigen::Vector2d(0, 0));
  EXPECT_FALSE(events.click(0));
  events.forget();
  EXPECT_EQ(events.drag(0), Eigen::Vector2d(0, 0));
  events.button(7, true);  // a mouse with many buttons
}

TEST(HandEvents, TellAClickFromADrag) {
  HandEvents events;
  events.cursor(100, 50);
  events.button(0, true);
  events.cursor(102, 51);  // no hand is still
  events.button(0, false);
  events.cursor(300, 300);
  ASSERT_TRUE(events.click(0));
  EXPECT_EQ(*events.click(0), Eigen::Vector2d(102, 51));
  EXPECT_EQ(events.drag(0), Eigen::Vector2d(0, 0)) << "a click does not turn the view";
  EXPECT_FALSE(events.click(1));
  events.forget();
  EXPECT_FALSE(events.click(0)) << "a click counts once";
  events.button(1, true);
  events.forget();  // a picture may come between down and up
  events.button(1, false);
  EXPECT_TRUE(events.click(1));
  events.button(0, true);
  events.cursor(303, 300);
  events.forget();
  events.cursor(306, 300);
  EXPECT_EQ(events.drag(0), Eigen::Vector2d(6, 0)) << "slow drags lose nothing of their way";
  events.cursor(300, 300);
  events.button(0, false);
  EXPECT_FALSE(events.click(0)) << "back where it began, and yet a drag";
}

TEST(HandEvents, CountCharactersWhateverKeyTheyAreOn) {
  HandEvents events;
  events.character('?');
  events.character('?');
  EXPECT_EQ(events.presses(HandEvents::of_character('?')), 2);
  EXPECT_EQ(events.presses('?'), 0) << "a key of the keyboard is another thing";
  events.character(0x1F600);  // is not kept
  EXPECT_EQ(events.presses(HandEvents::of_character(0x1F600)), 0);
}

}  // namespace
}  // namespace palpate::render
