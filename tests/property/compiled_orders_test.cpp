// What other tests of compiled kernels run over is all there: a kernel that is gone would pass them unseen.
#include <gmock/gmock.h>

#include <vector>

#include "support/compiled_kernels.hpp"

namespace zonal {
namespace {

using testing::ElementsAre;
using Layout = LobeVariant::Layout;

TEST(CompiledOrders, are_those_that_are_built) {
    std::vector<int> found;
    for (const CompiledOrder& compiled : compiled_orders()) found.push_back(compiled.order);
    EXPECT_THAT(found, ElementsAre(ZONAL_TEST_ORDERS));
}

TEST(CompiledOrders, have_every_kernel_that_they_are_to_have) {
    EXPECT_NO_THROW(orders_with_tensor());
    EXPECT_NO_THROW(lobes_of_all_orders({Layout::shared, Layout::ring, Layout::per_band}));
}

}  // namespace
}  // namespace zonal
