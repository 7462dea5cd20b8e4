#include "floc/io/usual_names.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "floc/base/parse_number.h"

namespace floc {
namespace {

using Names = std::set<std::string_view>;

/// Usual names of each quantity, in the form that without_capitals(plain(name)) returns.
const std::map<std::string, Names>& usual_names() {
  static const std::map<std::string, Names> names = {
      {"pressure",
       {"p", "P", "p'", "P'", "s'", "sv", "sv'", "s'v", "sigma", "sigma'", "sigmav", "sigmav'", "sigma'v",
        "sigmaz", "sigmaz'", "sigma'z", "sigman", "sigma'n", "sigman'", "sigma1", "sigma'1", "sigma1'",
        "sigmaeff", "sigmaveff", "sigma'eff", "sigmavertical", "pressure", "stress", "effectivestress",
        "verticalstress", "effectiveverticalstress", "verticaleffectivestress", "normalstress",
        "effectivenormalstress", "meanstress", "meaneffectivestress", "axialstress", "axialpressure",
        "appliedpressure", "appliedstress", "consolidationpressure", "consolidationstress",
        "compactionpressure", "compactionstress", "compressionpressure", "compressionstress", "punchpressure",
        "upperpunchpressure", "verticalpressure",
        // German
        "druck", "spannung", "effektivespannung", "vertikalspannung", "effektivevertikalspannung",
        "vertikaleeffektivespannung", "wirksamespannung", "normalspannung", "axialspannung", "auflast",
        "auflastspannung", "pressdruck", "pressspannung",
        // French, Spanish, Italian, Portuguese
        "pression", "contrainte", "contrainteeffective", "contrainteverticale", "contrainteverticaleeffective",
        "contrainteeffectiveverticale", "presion", "esfuerzo", "esfuerzoefectivo", "esfuerzovertical",
        "esfuerzoverticalefectivo", "esfuerzoefectivovertical", "tensionvertical", "tensionefectiva",
        "tensionverticalefectiva", "pressione", "tensione", "tensioneefficace", "tensioneverticale",
        "tensioneverticaleefficace", "pressao", "tensao", "tensaoefetiva", "tensaovertical",
        "tensaoverticalefetiva",
        // Polish, Czech, Dutch, Scandinavian languages
        "naprezenie", "naprezeniepionowe", "naprezenieefektywne", "pionowenaprezenieefektywne",
        "naprezeniepionoweefektywne", "cisnienie", "obciazenie", "napeti", "efektivninapeti", "svislenapeti",
        "tlak", "druk", "spanning", "korrelspanning", "verticalekorrelspanning", "tryck", "spanning",
        "effektivspanning", "trykk", "spenning", "effektivspenning", "tryk", "spaending",
        // Russian, Chinese, Japanese
        "давление", "напряжение", "压力", "应力", "竖向应力", "圧力", "応力", "圧密応力", "圧密圧力"}},
      {"void_ratio",
       {"e",
        "voidratio",
        "voidsratio",
        "porenzahl",
        "porenziffer",
        "indicedesvides",
        "indicedevides",
        "relaciondevacios",
        "indicedevacios",
        "indicedeporos",
        "indicedeivuoti",
        "indicedeivuotie",
        "indicedevazios",
        "wskaznikporowatosci",
        "cisloporovitosti",
        "poriengetal",
        "portal",
        "poretall",
        "poretal",
        "коэффициентпористости",
        "孔隙比",
        "間隙比"}},
      {"phi",
       {"phi",
        "D",
        "solidfraction",
        "solidsfraction",
        "solidvolumefraction",
        "solidsvolumefraction",
        "packingfraction",
        "packingdensity",
        "volumefraction",
        "relativedensity",
        "feststoffanteil",
        "packungsdichte",
        "raumerfullung",
        "relativedichte",
        "compacite",
        "fractionsolide",
        "densiterelative",
        "fraccionsolida",
        "densidadrelativa",
        "frazionesolida",
        "densitarelativa",
        "fracaosolida",
        "gestoscwzgledna",
        "固体分率",
        "相对密度",
        "相対密度"}},
      {"porosity",
       {"porosity", "porositat", "porenanteil", "hohlraumanteil", "porosite", "porosidad", "porosita",
        "porosidade", "porowatosc", "porovitost", "porositeit", "porositet", "пористость", "孔隙率", "間隙率"}},
      {"specific_volume",
       {"v", "specificvolume", "spezifischesvolumen", "volumespecifique", "volumenespecifico",
        "volumenespecifico"}},
      {"dry_density",
       {"drydensity", "rhod", "rhodry", "trockendichte", "densiteseche", "massevolumiqueseche", "densidadseca",
        "densitasecca", "densidadeseca", "gestoscobjetosciowaszkieletu", "drogevolumiekemassa",
        "torrdensitet"}},
      {"bulk_density",
       {"bulkdensity",
        "apparentdensity",
        "envelopedensity",
        "tabletdensity",
        "compactdensity",
        "density",
        "rho",
        "dichte",
        "schuttdichte",
        "rohdichte",
        "presslingsdichte",
        "densite",
        "massevolumique",
        "densidad",
        "densita",
        "densidade",
        "gestosc",
        "gestoscobjetosciowa",
        "hustota",
        "dichtheid",
        "densitet",
        "密度"}},
      {"axial_strain",
       {"axialstrain",
        "verticalstrain",
        "strain",
        "epsilon",
        "epsilona",
        "epsilonz",
        "epsilonv",
        "epsilon1",
        "eps",
        "epsa",
        "epsz",
        "eps1",
        "stauchung",
        "axialdehnung",
        "vertikaldehnung",
        "dehnung",
        "deformationaxiale",
        "deformationverticale",
        "deformacionaxial",
        "deformacionvertical",
        "deformazioneassiale",
        "deformazioneverticale",
        "deformacaoaxial",
        "odksztalcenie",
        "odksztalcenieosiowe",
        "odksztalceniepionowe",
        "pretvoreni",
        "verticalerek",
        "deformation"}},
      {"height",
       {"h",
        "H",
        "height",
        "sampleheight",
        "specimenheight",
        "tabletheight",
        "thickness",
        "tabletthickness",
        "hohe",
        "probenhohe",
        "steghohe",
        "dicke",
        "tablettendicke",
        "hauteur",
        "epaisseur",
        "altura",
        "altezza",
        "wysokosc",
        "wysokoscprobki",
        "vyska",
        "hoogte",
        "hojd",
        "hoyde"}},
      {"particle_density",
       {"particledensity", "truedensity", "graindensity", "soliddensity", "solidsdensity", "skeletaldensity",
        "rhos", "korndichte", "reindichte", "feststoffdichte", "densitedesgrains", "gestoscwlasciwa"}},
      {"initial_void_ratio", {"e0", "initialvoidratio", "anfangsporenzahl"}},
      {"initial_height", {"h0", "H0", "initialheight", "anfangshohe"}},
      {"sigma1",
       {"sigma1", "sigma'1", "sigma1'", "s1", "s1'", "axialstress", "majorprincipalstress", "verticalstress",
        "axialspannung", "grosstehauptspannung", "contrainteaxiale", "naprezenieosiowe"}},
      {"sigma3",
       {"sigma3", "sigma'3", "sigma3'", "s3", "s3'", "lateralstress", "radialstress", "minorprincipalstress",
        "confiningpressure", "confiningstress", "cellpressure", "seitendruck", "zelldruck", "radialspannung",
        "kleinstehauptspannung", "pressiondeconfinement", "cisnieniewkomorze"}},
      {"volumetric_strain",
       {"volumetricstrain", "volumestrain", "volumechange", "epsilonv", "epsilonvol", "epsv", "epsvol",
        "volumendehnung", "volumenanderung", "deformationvolumique", "odksztalcenieobjetosciowe"}},
      {"sigma_n",
       {"sigman", "sigman'", "sigma'n", "sn", "sn'", "sigma", "sigma'", "normalstress", "effectivenormalstress",
        "verticalstress", "normalspannung", "contraintenormale", "esfuerzonormal", "naprezenienormalne"}},
      {"tau",
       {"tau", "shearstress", "scherspannung", "schubspannung", "contraintedecisaillement", "cisaillement",
        "esfuerzocortante", "tensioneditaglio", "naprezeniescinajace"}},
      {"shear_strain",
       {"shearstrain", "gamma", "scherdehnung", "scherung", "gleitung", "distorsion", "deformacionangular",
        "odksztalceniepostaciowe"}},
      {"sieve_size", {"size",      "sieve",      "sievesize",       "sieveopening", "opening",   "aperture",
                      "meshsize",  "grainsize",  "particlesize",    "diameter",     "d",         "maschenweite",
                      "siebweite", "korngrosse", "korndurchmesser", "tamis",        "ouverture", "tamiz",
                      "abertura",  "sito",       "srednica"}},
      {"passing",
       {"passing", "percentpassing", "masspassing", "cumulativepassing", "finer", "percentfiner", "undersize",
        "q3", "Q3", "durchgang", "siebdurchgang", "passant", "tamisat", "pasa", "przechodzi", "%passing",
        "%finer"}},
      {"x", {"X", "xpos", "posx", "positionx", "xposition", "xcoordinate"}},
      {"y", {"Y", "ypos", "posy", "positiony", "yposition", "ycoordinate"}},
      {"z", {"Z", "zpos", "posz", "positionz", "zposition", "zcoordinate"}},
      {"radius", {"R", "radius", "radii", "rayon", "radio", "raggio", "promien", "polomer", "straal"}},
      {"x_low", {"xlow"}},
      {"y_low", {"ylow"}},
      {"z_low", {"zlow"}},
      {"diameter", {"d", "D", "diameter", "durchmesser", "diametre", "diametro", "srednica", "prumer"}},
      {"mass", {"m", "mass", "masse", "masa", "massa"}},
      {"id", {"ID", "Id", "iD", "particleid", "grainid", "idparticle"}},
      {"id1",
       {"id1", "idi", "i", "particle1", "particlei", "particleid1", "grain1", "graini", "grainid1", "body1",
        "bodyi"}},
      {"id2",
       {"id2", "idj", "j", "particle2", "particlej", "particleid2", "grain2", "grainj", "grainid2", "body2",
        "bodyj"}},
      {"normal_force",
       {"fn", "Fn", "FN", "fN", "normalforce", "normalcontactforce", "contactnormalforce", "normalkraft",
        "forcenormale", "fuerzanormal"}},
      {"force", {"N", "force", "contactforce"}},
      {"rolling_moment", {"rollingmoment", "rollingtorque", "mr", "Mr", "MR"}},
      {"twisting_moment",
       {"twistingmoment", "twistingtorque", "torsionmoment", "torsionalmoment", "torsiontorque"}},
      {"kn", {"kn", "Kn", "KN", "kN", "normalstiffness"}},
      {"kt", {"kt", "Kt", "KT", "kT", "ks", "Ks", "KS", "kS", "tangentialstiffness", "shearstiffness"}},
      {"kr", {"kr", "Kr", "KR", "kR", "rollingstiffness"}},
      {"ktw", {"ktw", "twistingstiffness", "torsionalstiffness"}},
      {"tensile_strength", {"tensilestrength", "normalstrength"}},
      {"shear_strength", {"shearstrength", "tangentialstrength"}},
      {"rolling_strength", {"rollingstrength"}},
      {"twisting_strength", {"twistingstrength", "torsionalstrength"}},
      {"bridge_volume", {"bridgevolume", "liquidvolume", "liquidbridgevolume"}},
      {"bonded", {"bonded", "isbonded"}},
      {"gap", {"gap"}},
      {"kind", {"kind"}},
  };
  return names;
}

/// Usual names of vectors, in the form that plain() returns, without capitals. The name of a component follows from the
/// name of its vector: "force1", "forcex" and "force[1]" are the first component of "force".
const std::map<std::string, Names>& usual_vectors() {
  static const std::map<std::string, Names> names = {
      {"image", {"image", "img", "cell", "periodicimage"}},
      {"force", {"force", "f", "contactforce", "totalforce", "normalforce", "fn"}},
      {"shear_force", {"shearforce", "tangentialforce", "frictionforce", "fs", "ft"}},
      {"rolling_moment", {"rollingmoment", "rollingtorque", "mr"}},
      {"point", {"point", "contactpoint", "contactposition", "cp"}},
      {"normal", {"normal", "contactnormal", "n"}},
  };
  return names;
}

/// Replacement, in a plain name, of one character or several successive characters outside ASCII.
struct Plain {
  std::string_view from, to;
};
constexpr auto kPlain = std::to_array<Plain>({
    {"σ", "sigma"},   {"Σ", "sigma"}, {"φ", "phi"},   {"ϕ", "phi"}, {"Φ", "Phi"}, {"ε", "epsilon"},
    {"ϵ", "epsilon"}, {"τ", "tau"},   {"γ", "gamma"}, {"ρ", "rho"}, {"′", "'"},   {"’", "'"},
    {"‘", "'"},       {"´", "'"},     {"`", "'"},     {"ʹ", "'"},   {"ᵥ", "v"},   {"₀", "0"},
    {"₁", "1"},       {"ₛ", "s"},     {"ₙ", "n"},     {"ₐ", "a"},   {" ", ""},    {" ", ""},
    {"–", ""},        {"ß", "ss"},    {"ä", "a"},     {"Ä", "a"},   {"ö", "o"},   {"Ö", "o"},
    {"ü", "u"},       {"Ü", "u"},     {"á", "a"},     {"à", "a"},   {"â", "a"},   {"ã", "a"},
    {"å", "a"},       {"æ", "ae"},    {"ą", "a"},     {"ç", "c"},   {"ć", "c"},   {"č", "c"},
    {"é", "e"},       {"è", "e"},     {"ê", "e"},     {"ë", "e"},   {"ę", "e"},   {"ě", "e"},
    {"É", "e"},       {"í", "i"},     {"î", "i"},     {"ï", "i"},   {"ł", "l"},   {"Ł", "l"},
    {"ñ", "n"},       {"ń", "n"},     {"ň", "n"},     {"ó", "o"},   {"ô", "o"},   {"õ", "o"},
    {"ø", "o"},       {"ř", "r"},     {"ś", "s"},     {"Ś", "s"},   {"š", "s"},   {"ů", "u"},
    {"ú", "u"},       {"ù", "u"},     {"û", "u"},     {"ý", "y"},   {"ź", "z"},   {"ż", "z"},
    {"ž", "z"},       {"Ż", "z"},
});

/// Returns a name without blanks, hyphens, underscores, TeX characters and accents, and with Greek letters spelled out.
std::string plain(std::string_view name) {
  constexpr std::string_view kLeftOut = " \t_-.^{}$\\*";
  std::string text;
  while (!name.empty()) {
    const auto known =
        std::find_if(kPlain.begin(), kPlain.end(), [&](const Plain& p) { return name.starts_with(p.from); });
    if (known != kPlain.end()) {
      text += known->to;
      name.remove_prefix(known->from.size());
      continue;
    }
    if (kLeftOut.find(name.front()) == std::string_view::npos) text += name.front();
    name.remove_prefix(1);
  }
  return text;
}

/// Returns a plain name in small letters. Names of one or two letters are returned unchanged: they are symbols, in
/// which capitals have a meaning.
std::string without_capitals(std::string name) {
  if (name.size() <= 2) return name;
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

/// Whether a header is a usual name of a component of a vector.
/// @param quantity  name that floc uses for the component, such as "force1"
bool is_usual_component(const std::string& quantity, std::string_view header) {
  const char index = quantity.back();
  if (index < '1' || index > '3') return false;
  const auto found = usual_vectors().find(quantity.substr(0, quantity.size() - 1));
  if (found == usual_vectors().end()) return false;
  std::string name = plain(header);
  if (name.ends_with(']') && name.size() > 3 && name[name.size() - 3] == '[')
    name = name.substr(0, name.size() - 3) + name[name.size() - 2];
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const bool has_index = name.ends_with(index) || name.ends_with("xyz"[index - '1']);
  return has_index && found->second.contains(std::string_view(name).substr(0, name.size() - 1));
}

bool is_one_of(const Names& names, std::string_view part) {
  return names.contains(without_capitals(plain(part)));
}

/// Splits a name at brackets, commas, colons and equals signs.
std::vector<std::string_view> parts_of(std::string_view name) {
  std::vector<std::string_view> parts;
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of(",()[]=:;"), name.size());
    if (!trimmed(name.substr(0, end)).empty()) parts.push_back(trimmed(name.substr(0, end)));
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return parts;
}

const std::string& key_of(const std::string& quantity) {
  static const std::map<std::string, std::string> same = {{"P", "pressure"},
                                                          {"P_star", "pressure"},
                                                          {"p", "pressure"},
                                                          {"e", "void_ratio"},
                                                          {"strain", "axial_strain"}};
  const auto found = same.find(quantity);
  return found == same.end() ? quantity : found->second;
}

}  // namespace

bool is_usual_name(const std::string& quantity, const std::string& header) {
  if (is_usual_component(quantity, header)) return true;
  const auto found = usual_names().find(key_of(quantity));
  if (found == usual_names().end()) return false;
  const Names& names = found->second;
  if (is_one_of(names, header)) return true;
  const std::vector<std::string_view> parts = parts_of(header);
  if (parts.size() > 1)
    return std::all_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return is_one_of(names, part); });
  const std::size_t blank = header.find_last_of(' ');
  return blank != std::string::npos && is_one_of(names, std::string_view(header).substr(0, blank)) &&
         is_one_of(names, std::string_view(header).substr(blank + 1));
}

}  // namespace floc
