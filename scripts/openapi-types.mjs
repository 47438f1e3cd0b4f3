// Turns the schemas of an OpenAPI document into TypeScript types, one exported type a schema.

const HEADER = '// Generated from openapi.json by `npm run gen`; never edited by hand.\n';
const identifier = /^[A-Za-z_$][\w$]*$/;

/** TypeScript source of all `components.schemas`, in the document's order. */
export function typesOf(document) {
  const declarations = Object.entries(document.components.schemas).map(([name, schema]) => declaration(name, schema));
  return `${HEADER}\n${declarations.join('\n')}`;
}

function declaration(name, schema) {
  if (!identifier.test(name)) {
    throw new Error(`Schema "${name}" is no TypeScript name; serve one schema for input and output (separate_input_output_schemas=False).`);
  }
  const comment = schema.description ? `/** ${commented(schema.description)} */\n` : '';
  return `${comment}export type ${name} = ${typeOf(schema)};\n`;
}

function typeOf(schema) {
  if (schema.$ref) return schema.$ref.split('/').at(-1);
  if ('const' in schema) return literal(schema.const);
  if (schema.enum) return schema.enum.map(literal).join(' | ');
  const choices = schema.anyOf ?? schema.oneOf;
  if (choices) return choices.map(typeOf).join(' | ');
  switch (schema.type) {
    case 'object':
      return objectType(schema);
    case 'array':
      return schema.prefixItems ? `[${schema.prefixItems.map(typeOf).join(', ')}]` : `${grouped(schema.items)}[]`;
    case 'integer':
    case 'number':
      return 'number';
    case 'string':
      return schema.format === 'binary' ? 'Blob' : 'string';
    case 'boolean':
    case 'null':
      return schema.type;
    case undefined:
      return 'unknown';
    default:
      throw new Error(`Schema type "${schema.type}" has no TypeScript counterpart here.`);
  }
}

function objectType(schema) {
  const entries = Object.entries(schema.properties ?? {});
  if (entries.length === 0) {
    const values = typeof schema.additionalProperties === 'object' ? typeOf(schema.additionalProperties) : 'unknown';
    return `{ [key: string]: ${values} }`;
  }
  const required = new Set(schema.required ?? []);
  const fields = entries.map(
    ([key, value]) => `  ${fieldName(key)}${required.has(key) || isAlwaysPresent(value) ? '' : '?'}: ${typeOf(value)};`,
  );
  return `{\n${fields.join('\n')}\n}`;
}

/** The server writes every default; only fields whose default is null may be left out. */
const isAlwaysPresent = (schema) => 'const' in schema || ('default' in schema && schema.default !== null);
const fieldName = (key) => (identifier.test(key) ? key : literal(key));
const grouped = (schema) => (/[|]/.test(typeOf(schema)) ? `(${typeOf(schema)})` : typeOf(schema));
const literal = (value) => (typeof value === 'string' ? `'${value.replaceAll("'", "\\'")}'` : JSON.stringify(value));
const commented = (text) => text.split('\n').join('\n * ').replace(/ +$/gm, '');
