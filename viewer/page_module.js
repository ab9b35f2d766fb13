// Starts a module of WebAssembly, for the page and, as text, for its worker: it
// uses nothing that only one of them has.  Resolves to what it exports, a
// reader of its texts and a writer of numbers into its memory.  What the
// library throws in it is thrown here.
async function startModule(module) {
  let calls = null;
  const text = address => {
    const bytes = new Uint8Array(calls.memory.buffer, address);
    return new TextDecoder().decode(
        bytes.subarray(0, Math.min(bytes.indexOf(0), 500)));
  };
  const put = (numbers, Kind) => {
    const at = calls.allocate(numbers.length * Kind.BYTES_PER_ELEMENT);
    new Kind(calls.memory.buffer, at, numbers.length).set(numbers);
    return at;
  };
  const nothing = () => 0;
  const tellTime = (clock, precision, at) => {
    new DataView(calls.memory.buffer).setBigUint64(
        at, BigInt(Math.round(performance.now() * 1e6)), true);
    return 0;
  };
  const wasi = {environ_get: nothing, environ_sizes_get: nothing,
                fd_close: nothing, fd_seek: nothing, fd_write: nothing,
                proc_exit: nothing, clock_time_get: tellTime};
  const made = await WebAssembly.instantiate(module, {
    page: {fail: why => { throw new Error(text(why)); }},
    wasi_snapshot_preview1: wasi,
  });
  calls = made.instance.exports;
  calls._initialize();
  return {calls, text, put};
}
