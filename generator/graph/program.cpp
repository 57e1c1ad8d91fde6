// A kernel as loops over evenly spaced elements instead of one statement a value.
//
// Method: values of one group are sorted by depth and operation; equal ones form a batch that needs no order
// within. A batch is sorted by where its operands lie, so that neighbours often have neighbouring operands,
// and its results take neighbouring slots; entries of a matrix that is stored or multiplied by lie row by
// row, whatever batch makes them. Each batch is then cut into evenly spaced runs. Known limit: kernels
// without regular structure give short runs.
#include "graph/program.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "graph/schedule.hpp"

namespace zonal::graph {

namespace {

constexpr int kUnranked = std::numeric_limits<int>::max();

/// What the runs of one loop share, strides apart.
struct Form {
    Op op = Op::constant;
    bool negated_product = false;
    bool negated_addend = false;
    Place result;
    std::vector<Place> operands;
    auto operator<=>(const Form&) const = default;
};

/// One operation with the elements it works on: a run of one.
struct Step {
    int result = 0;
    std::vector<int> operands;
};

/// Scratch memory: which slots hold a value that is still needed.
class Slots {
  public:
    /// The first of `count` free neighbours.
    int take(int count) {
        int start = 0;
        for (int end = 0; end < start + count; ++end) {
            if (end == static_cast<int>(is_taken_.size())) is_taken_.push_back(false);
            if (is_taken_[end]) start = end + 1;
        }
        std::fill_n(is_taken_.begin() + start, count, true);
        return start;
    }
    void release(int slot) { is_taken_[slot] = false; }
    int size() const { return static_cast<int>(is_taken_.size()); }

  private:
    std::vector<bool> is_taken_;
};

/// The longest evenly spaced run from step `first` on.
Run longest_run(const std::vector<Step>& steps, int first) {
    const Step& start = steps[first];
    Run run{1, {start.result, 1}, {}};
    for (const int operand : start.operands) run.operands.push_back({operand, 1});
    const auto continues = [&](const Step& step) {
        if (step.result != run.result.start + run.count * run.result.step) return false;
        for (std::size_t k = 0; k < run.operands.size(); ++k)
            if (step.operands[k] != run.operands[k].start + run.count * run.operands[k].step) return false;
        return true;
    };
    if (first + 1 == static_cast<int>(steps.size())) return run;
    run.result.step = steps[first + 1].result - start.result;
    for (std::size_t k = 0; k < run.operands.size(); ++k)
        run.operands[k].step = steps[first + 1].operands[k] - start.operands[k];
    while (first + run.count < static_cast<int>(steps.size()) && continues(steps[first + run.count]))
        ++run.count;
    return run;
}

/// Cuts steps into runs. Two steps always agree: a pair gives its second step to a longer run behind it.
std::vector<Run> cut_into_runs(const std::vector<Step>& steps) {
    std::vector<Run> runs;
    for (int at = 0; at < static_cast<int>(steps.size()); at += runs.back().count) {
        Run run = longest_run(steps, at);
        if (run.count == 2 && longest_run(steps, at + 1).count > 2) run.count = 1;
        runs.push_back(std::move(run));
    }
    return runs;
}

/// Shorter runs cost more than their elements one by one.
constexpr int kShortestEven = 4;
constexpr int kShortestSpaced = 8;

bool is_even(const Run& run) {
    return run.count >= kShortestEven && run.result.step == 1 &&
           std::all_of(run.operands.begin(), run.operands.end(),
                       [](const Elements& operand) { return operand.step == 0 || operand.step == 1; });
}

/// Element `i` of a run as a run of its own.
Run element(const Run& run, int i) {
    Run single{1, {run.result.start + i * run.result.step, 1}, {}};
    for (const Elements& operand : run.operands)
        single.operands.push_back({operand.start + i * operand.step, 1});
    return single;
}

class Builder {
  public:
    explicit Builder(const Kernel& kernel)
        : kernel_(kernel),
          stage_of_(kernel.graph.size(), -1),
          place_(kernel.graph.size(), -1),
          depth_(kernel.graph.size(), 0),
          last_reader_(kernel.graph.size(), -1),
          is_kept_(kernel.graph.size(), false),
          rank_(kernel.graph.size(), kUnranked) {}

    Program build() {
        split_into_stages();
        note_readers();
        for (const Stage& stage : stages_) {
            take_kept(stage);
            for (const Batch& batch : stage) run(batch);
        }
        program_.rotation_slots = rotation_slots_.size();
        program_.signal_slots = signal_slots_.size();
        for (const Id id : constants_) program_.constants.push_back(node(id).value);
        return std::move(program_);
    }

  private:
    /// Values of equal depth and form, or stores: nothing in a batch needs anything else in it.
    struct Batch {
        Form form;
        std::vector<Statement> statements;
    };
    using Stage = std::vector<Batch>;

    const Node& node(Id id) const { return kernel_.graph[id]; }

    Place place_of(Id id) const {
        if (node(id).op == Op::constant) return {Memory::constants, 0};
        return {node(id).kind == Kind::signal ? Memory::signal_slots : Memory::rotation_slots, 0};
    }

    Form form_of(const Statement& statement) const {
        const Node& made = node(statement.node);
        if (statement.is_store)
            return {Op::constant, false, false, {Memory::output, 0}, {place_of(statement.node)}};
        Form form{made.op, made.negated_product, made.negated_addend, place_of(statement.node), {}};
        for (const Id operand : made.operands) form.operands.push_back(place_of(operand));
        if (made.op == Op::input) form.operands = {{Memory::input, made.array}};
        return form;
    }

    /// A stage is a group of stores and what it needs. Rotations are read before anything is written.
    void split_into_stages() {
        std::vector<Statement> computed, stores;
        for (Id id = 0; id < kernel_.graph.size(); ++id)
            if (node(id).op == Op::input && node(id).kind == Kind::rotation)
                computed.push_back({false, id, 0});
        for (const Statement& statement : schedule(kernel_)) {
            if (!statement.is_store && !stores.empty()) add_stage(computed, stores);
            (statement.is_store ? stores : computed).push_back(statement);
        }
        add_stage(computed, stores);
    }

    void add_stage(std::vector<Statement>& computed, std::vector<Statement>& stores) {
        add_signal_inputs(computed, stores);
        const int number = static_cast<int>(stages_.size());
        // Rotation scalars never wait for signal values, so that these come last, in step with each other.
        std::map<std::tuple<Kind, int, Form>, std::vector<Statement>> batches;
        for (const Statement& statement : computed) {
            const Node& made = node(statement.node);
            int depth = 0;
            for (const Id operand : made.operands)
                if (node(operand).kind == made.kind && stage_of_[operand] == number)
                    depth = std::max(depth, depth_[operand] + 1);
            depth_[statement.node] = depth;
            stage_of_[statement.node] = number;
            batches[{made.kind, depth, form_of(statement)}].push_back(statement);
        }
        Stage stage;
        for (auto& [key, statements] : batches) stage.push_back({std::get<Form>(key), std::move(statements)});
        std::map<Form, std::vector<Statement>> writing;
        for (const Statement& store : stores) writing[form_of(store)].push_back(store);
        for (auto& [form, statements] : writing) stage.push_back({form, std::move(statements)});
        stages_.push_back(std::move(stage));
        computed.clear();
        stores.clear();
    }

    /// Elements of the signal are copied into slots by the first stage that needs them.
    void add_signal_inputs(std::vector<Statement>& computed, const std::vector<Statement>& stores) {
        std::vector<Id> needed;
        for (const std::vector<Statement>* statements : {&std::as_const(computed), &stores})
            for (const Statement& statement : *statements)
                for (const Id id : operands_of(statement)) needed.push_back(id);
        std::sort(needed.begin(), needed.end());
        needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
        std::vector<Statement> inputs;
        for (const Id id : needed)
            if (node(id).op == Op::input && node(id).kind == Kind::signal && stage_of_[id] < 0)
                inputs.push_back({false, id, 0});
        computed.insert(computed.begin(), inputs.begin(), inputs.end());
    }

    /// Backwards for ranks: a minus sign has its own before it hands it on.
    void note_readers() {
        int at = 0;
        for (const Stage& stage : stages_)
            for (const Batch& batch : stage) {
                for (const Statement& statement : batch.statements)
                    for (const Id id : operands_of(statement)) last_reader_[id] = at;
                ++at;
            }
        for (int stage = static_cast<int>(stages_.size()) - 1; stage >= 0; --stage)
            for (auto batch = stages_[stage].rbegin(); batch != stages_[stage].rend(); ++batch)
                for (const Statement& statement : batch->statements)
                    for (const Id id : operands_of(statement)) note_reader(statement, id, stage);
    }

    Operands operands_of(const Statement& statement) const {
        return statement.is_store ? Operands{statement.node} : node(statement.node).operands;
    }

    /// What a store, a signal value or a later stage reads is kept: in the order of those outputs or signal
    /// values, so that rows of a matrix stay rows whichever batches make their elements.
    void note_reader(const Statement& reader, Id id, int stage) {
        if (reader.is_store) {
            rank_[id] = std::min(rank_[id], reader.index);
        } else if (node(reader.node).op == Op::negate) {
            rank_[id] = std::min(rank_[id], rank_[reader.node]);
        } else if (node(reader.node).kind == Kind::signal && node(id).kind == Kind::rotation) {
            rank_[id] = std::min(rank_[id], reader.node);
        }
        if (node(id).op != Op::negate && (stage_of_[id] != stage || rank_[id] < kUnranked))
            is_kept_[id] = true;
    }

    Slots& slots_of(Id id) { return node(id).kind == Kind::signal ? signal_slots_ : rotation_slots_; }

    /// Kept values are neighbours in their order; all others in the order they are computed in.
    void take_kept(const Stage& stage) {
        std::map<Kind, std::vector<Id>> kept;
        for (const Batch& batch : stage)
            for (const Statement& statement : batch.statements)
                if (!statement.is_store && is_kept_[statement.node])
                    kept[node(statement.node).kind].push_back(statement.node);
        for (auto& [kind, ids] : kept) {
            std::sort(ids.begin(), ids.end(),
                      [&](Id a, Id b) { return std::pair(rank_[a], a) < std::pair(rank_[b], b); });
            give_slots(ids);
        }
    }

    void give_slots(const std::vector<Id>& ids) {
        if (ids.empty()) return;
        int slot = slots_of(ids.front()).take(static_cast<int>(ids.size()));
        for (const Id id : ids) place_[id] = slot++;
    }

    std::vector<int> operand_elements(const Statement& statement) const {
        if (statement.is_store) return {slot_or_constant(statement.node)};
        if (node(statement.node).op == Op::input) return {node(statement.node).index};
        std::vector<int> elements;
        for (const Id operand : node(statement.node).operands) elements.push_back(slot_or_constant(operand));
        return elements;
    }

    /// Constants are placed run by run, so that they never end one.
    int slot_or_constant(Id id) const { return node(id).op == Op::constant ? 0 : place_[id]; }

    void run(const Batch& batch) {
        std::vector<Statement> statements = batch.statements;
        const auto key = [&](const Statement& s) {
            return std::tuple(s.is_store ? s.index : place_[s.node], operand_elements(s), s.node);
        };
        std::sort(statements.begin(), statements.end(),
                  [&](const Statement& a, const Statement& b) { return key(a) < key(b); });
        std::vector<Id> fresh;
        for (const Statement& statement : statements)
            if (!statement.is_store && place_[statement.node] < 0) fresh.push_back(statement.node);
        give_slots(fresh);
        std::vector<Step> steps;
        for (const Statement& statement : statements)
            steps.push_back(
                {statement.is_store ? statement.index : place_[statement.node], operand_elements(statement)});
        std::vector<Run> runs = cut_into_runs(steps);
        place_constants(statements, runs);
        add_loops(batch.form, runs);
        release_what_is_done(batch);
        ++batches_done_;
    }

    /// Constants lie wherever a run wants them: among those of earlier runs if they are there in its order,
    /// else behind them.
    void place_constants(const std::vector<Statement>& statements, std::vector<Run>& runs) {
        int at = 0;
        for (Run& run : runs) {
            for (int k = 0; k < static_cast<int>(run.operands.size()); ++k) {
                std::vector<Id> needed;
                for (int i = at; i < at + run.count; ++i) needed.push_back(operand_of(statements[i], k));
                if (node(needed.front()).op == Op::constant) run.operands[k] = find_constants(needed);
            }
            at += run.count;
        }
    }

    Id operand_of(const Statement& statement, int k) const {
        const Node& made = node(statement.node);
        return statement.is_store || made.op == Op::input ? statement.node : made.operands[k];
    }

    Elements find_constants(std::vector<Id> needed) {
        const bool are_equal =
            std::count(needed.begin(), needed.end(), needed.front()) == static_cast<int>(needed.size());
        if (are_equal) needed.resize(1);
        auto found = std::search(constants_.begin(), constants_.end(), needed.begin(), needed.end());
        const int start = static_cast<int>(found - constants_.begin());
        if (found == constants_.end()) constants_.insert(found, needed.begin(), needed.end());
        return {start, are_equal ? 0 : 1};
    }

    void add_loops(const Form& form, const std::vector<Run>& runs) {
        std::map<std::pair<Spacing, std::vector<int>>, std::vector<Run>> loops;
        for (const Run& run : runs) {
            if (is_even(run)) {
                std::vector<int> steps;
                for (const Elements& operand : run.operands) steps.push_back(operand.step);
                loops[{Spacing::even, steps}].push_back(run);
            } else if (run.count >= kShortestSpaced) {
                loops[{Spacing::spaced, {}}].push_back(run);
            } else {
                for (int i = 0; i < run.count; ++i)
                    loops[{Spacing::scattered, {}}].push_back(element(run, i));
            }
        }
        for (auto& [key, of_one_spacing] : loops)
            program_.loops.push_back({form.op, form.negated_product, form.negated_addend, form.result,
                                      form.operands, key.first, key.second, of_one_spacing});
    }

    /// Only after a batch: its steps may run in any order, so none may write what another reads.
    void release_what_is_done(const Batch& batch) {
        const auto release = [&](Id id) {
            if (last_reader_[id] != batches_done_ || node(id).op == Op::constant) return;
            slots_of(id).release(place_[id]);
            last_reader_[id] = -1;
        };
        for (const Statement& statement : batch.statements)
            for (const Id id : operands_of(statement)) release(id);
    }

    const Kernel& kernel_;
    Program program_;
    std::vector<Stage> stages_;
    std::vector<int> stage_of_;  ///< -1: none yet
    std::vector<int> place_;     ///< the slot of a value
    std::vector<int> depth_;
    std::vector<int> last_reader_;  ///< the batch that reads a value last
    std::vector<bool> is_kept_;
    std::vector<int> rank_;  ///< the order of kept values: see note_reader
    Slots rotation_slots_, signal_slots_;
    std::vector<Id> constants_;
    int batches_done_ = 0;
};

}  // namespace

Program make_program(const Kernel& kernel) { return Builder(kernel).build(); }

}  // namespace zonal::graph
