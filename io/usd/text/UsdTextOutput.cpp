#include "io/usd/text/UsdTextOutput.h"

namespace penumbra {

std::string_view usdPrefix(UsdListOp op) {
    switch (op) {
    case UsdListOp::explicitly:
        return "";
    case UsdListOp::add:
        return "add ";
    case UsdListOp::prepend:
        return "prepend ";
    case UsdListOp::append:
        return "append ";
    case UsdListOp::remove:
        return "delete ";
    case UsdListOp::reorder:
        return "reorder ";
    }
    return "";
}

bool isUsdReorder(const UsdNamedValue& entry) {
    if (entry.value.type.kind != UsdKind::string || !entry.value.type.array) return false;
    return entry.name == "reorder rootPrims" || entry.name == "reorder nameChildren" ||
           entry.name == "reorder properties";
}

void UsdTextOutput::metadata(const UsdDictionary& entries) {
    for (const UsdNamedValue& entry : entries) {
        if (isUsdReorder(entry)) continue;
        line();
        const bool comment = entry.name == "comment" && entry.value.text();
        if (!comment) text.append(entry.name).append(" = ");
        appendUsdText(text, entry.value, depth);
        text += '\n';
    }
}

namespace {

class PropertyWriter {
public:
    PropertyWriter(UsdTextOutput& out, const UsdProperty& property)
        : out_(out), property_(property) {}

    // One statement with the metadata, if there is any or nothing else declares the property; then
    // what has statements of its own.
    void write() {
        const bool declared = !property_.targets.empty() || property_.hasSamples;
        if (!declared || !property_.value.empty() || !property_.metadata.empty()) {
            declaration(UsdListOp::explicitly, "");
            if (!property_.value.empty()) {
                out_.text += " = ";
                appendUsdText(out_.text, property_.value, out_.depth);
            }
            metadata();
        }
        if (property_.hasSamples) samples();
        targets();
    }

private:
    void declaration(UsdListOp op, std::string_view suffix) {
        std::string& text = out_.line() += usdPrefix(op);
        if (property_.custom) text += "custom ";
        if (property_.relationship) {
            text += property_.varying ? "varying rel " : "rel ";
        } else {
            if (property_.uniform) text += "uniform ";
            text += property_.typeName + (property_.type.array ? "[] " : " ");
        }
        text.append(property_.name).append(suffix);
    }

    void metadata() {
        if (!property_.metadata.empty()) {
            out_.text += " (\n";
            ++out_.depth;
            out_.metadata(property_.metadata);
            --out_.depth;
            out_.line() += ')';
        }
        out_.text += '\n';
    }

    void samples() {
        declaration(UsdListOp::explicitly, ".timeSamples = {\n");
        for (const UsdTimeSample& sample : property_.samples) {
            out_.line() += "    ";
            const UsdValue time{{UsdKind::float64}, std::vector<double>{sample.time}};
            appendUsdText(out_.text, time, 0);
            out_.text += ": ";
            appendUsdText(out_.text, sample.value, out_.depth + 1);
            out_.text += ",\n";
        }
        out_.line() += "}\n";
    }

    void targets() {
        for (const UsdListEdit<std::string>& edit : property_.targets) {
            declaration(edit.op, property_.relationship ? " = " : ".connect = ");
            out_.list(edit.items, false,
                      [&](const std::string& path) { out_.text += "<" + path + ">"; });
            out_.text += '\n';
        }
    }

    UsdTextOutput& out_;
    const UsdProperty& property_;
};

} // namespace

void writeUsdProperty(UsdTextOutput& out, const UsdProperty& property) {
    PropertyWriter(out, property).write();
}

} // namespace penumbra
