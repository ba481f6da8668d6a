// Corrections that the user makes in the page: fields that differ from the document, and the file that holds them.

const FORMAT = "scene2hap/overrides";
const VERSION = 1;

/** Corrections of a document. A field that is set back to the document's value is no longer a correction. */
export function makeCorrections(report, onChange) {
  const changed = new Map(); // id -> Map of "field" or "field/state" -> {field, state, value}

  const given = (id, field, state) => {
    const editable = report.byId.get(id)?.editable;
    if (!editable) return undefined;
    return state === null ? editable[field] : editable.states.find((one) => one.name === state)?.[field];
  };

  return {
    /** The present value of a field: the corrected one, or the document's. */
    value(id, field, state = null) {
      const entry = changed.get(id)?.get(JSON.stringify([field, state]));
      return entry ? entry.value : given(id, field, state);
    },
    isChanged: (id, field, state = null) => changed.get(id)?.has(JSON.stringify([field, state])) ?? false,
    set(id, field, value, state = null) {
      const fields = changed.get(id) ?? new Map();
      const key = JSON.stringify([field, state]);
      if (value === null || value === given(id, field, state)) fields.delete(key);
      else fields.set(key, { field, state, value });
      if (fields.size > 0) changed.set(id, fields);
      else changed.delete(id);
      onChange();
    },
    reset(id) {
      changed.delete(id);
      onChange();
    },
    has: (id) => changed.has(id),
    get count() {
      return [...changed.values()].reduce((all, fields) => all + fields.size, 0);
    },
    /** The file of corrections. Ids are any text; `fromEntries` makes own properties of all, even of "__proto__". */
    file() {
      const rows = [...changed].map(([id, fields]) => {
        const row = {};
        for (const { field, state, value } of fields.values()) {
          if (state === null) row[field] = value;
          else row[field] = Object.fromEntries([...Object.entries(row[field] ?? {}), [state, value]]);
        }
        return [id, row];
      });
      return { format: FORMAT, version: VERSION, overrides: Object.fromEntries(rows) };
    },
  };
}
