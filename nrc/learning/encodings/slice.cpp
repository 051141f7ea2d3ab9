#include "nrc/learning/encodings/slice.h"

#include "nrc/learning/encodings/kind.h"
#include "shared/constants.h"

namespace irradia {
namespace {

class PlainPasses : public SlicePasses {
public:
    explicit PlainPasses(const SliceContext& context)
        : name_(context.slice.kind->kernel->name)
        , encode_(makeSliceKernel(context, *context.slice.kind->kernel, *context.slice.kind->halfKernel,
                                  context.slice.kind->constants
                                      ? context.slice.kind->constants(context.slice.config)
                                      : std::vector<uint32_t>{})) {}

    void encode(FrameGraph& graph, const RowCount& rows, BufferRange inputs, BufferRange /*features*/,
                BufferRange encoded) const override {
        graph.pass(encode_, name_)
            .read(rows.counters)
            .read(inputs)
            .write(encoded)
            .push(rowsParams(rows))
            .dispatch(rows.capacity);
    }

private:
    const char* name_; // the same in both precisions
    Kernel encode_;
};

} // namespace

Kernel makeSliceKernel(const SliceContext& context, const KernelSource& single, const KernelSource& half,
                       std::span<const uint32_t> own) {
    const EncodingSlice& slice = context.slice;
    KernelOptions options;
    options.constants = {{gpu::kConstantSliceInputQuads, context.layout.inputQuads()},
                         {gpu::kConstantSliceFirstInput, slice.firstInput},
                         {gpu::kConstantSliceDims, slice.config.dims},
                         {gpu::kConstantSliceEncodedQuads, context.layout.encodedQuads},
                         {gpu::kConstantSliceFirstQuad, slice.firstQuad},
                         {gpu::kConstantSlicePaddingQuads, slice.paddingQuads}};
    uint32_t id = gpu::kConstantOwn;
    for (const uint32_t value : own) options.constants.push_back({id++, value});
    return Kernel(context.device, context.precision == Precision::Half ? half : single, options);
}

gpu::RowsParams rowsParams(const RowCount& rows) {
    return {rows.index, rows.capacity, rows.first, 0, {}};
}

std::unique_ptr<SlicePasses> makePlainPasses(const SliceContext& context) {
    return std::make_unique<PlainPasses>(context);
}

} // namespace irradia
